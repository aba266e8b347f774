#include "grove/scene/pbrt/context.h"

namespace grove::pbrt {

void Warnings::add(const Place& place, std::string_view text) {
  if (seen_.contains(text)) return;
  seen_.emplace(text);
  texts_.emplace_back(text);
  lines_.push_back(place.text() + ": " + std::string(text));
}

void Warnings::merge(const Warnings& other) {
  for (std::size_t i = 0; i < other.texts_.size(); ++i) {
    if (!seen_.insert(other.texts_[i]).second) continue;
    texts_.push_back(other.texts_[i]);
    lines_.push_back(other.lines_[i]);
  }
}

std::filesystem::path resolve_file(const std::filesystem::path& directory, std::string_view name) {
  const std::filesystem::path path(name);
  return path.is_absolute() ? path : directory / path;
}

}  // namespace grove::pbrt

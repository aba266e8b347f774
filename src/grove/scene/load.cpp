#include "grove/scene/load.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <new>
#include <system_error>

#include "grove/base/error.h"
#include "grove/base/timer.h"
#include "grove/scene/load_animated.h"

namespace grove {
namespace {

constexpr std::string_view kBuiltinPrefix = "builtin:";

struct Format {
  std::string_view extension;
  Scene (*load)(const std::filesystem::path&);
};

constexpr std::array<Format, 7> kFormats{{{".gltf", load_gltf},
                                          {".glb", load_gltf},
                                          {".pbrt", load_pbrt},
                                          {".obj", load_obj},
                                          {".ply", load_ply},
                                          {".ply.gz", load_ply},
                                          {".stl", load_stl}}};

std::string lower_case(std::string text) {
  // By hand rather than std::tolower, which depends on the program's locale.
  std::transform(text.begin(), text.end(), text.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return text;
}

const Format& find_format(const std::string& source, const std::filesystem::path& file) {
  const std::string name = lower_case(file.filename().string());
  const auto found = std::find_if(kFormats.begin(), kFormats.end(), [&](const Format& f) { return name.ends_with(f.extension); });
  if (found != kFormats.end()) return *found;
  std::string known;
  for (const Format& format : kFormats) known += std::string(known.empty() ? "" : " ") + std::string(format.extension);
  throw InputError(source, "", "unknown scene format; what is read: " + known + ", or builtin:NAME");
}

// One clear line for whatever keeps a path from being read, before any reader sees it.
void check_readable(const std::string& source, const std::filesystem::path& file) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(file, error);
  if (status.type() == std::filesystem::file_type::not_found) throw InputError(source, "", "no such file");
  if (error) throw InputError(source, "", "cannot be read: " + error.message());
  if (std::filesystem::is_directory(status)) throw InputError(source, "", "is a directory; name a scene file inside it");
  if (!std::filesystem::is_regular_file(status)) throw InputError(source, "", "is not a regular file");
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> probe(std::fopen(file.c_str(), "rb"), &std::fclose);
  if (probe == nullptr) {
    throw InputError(source, "", "cannot be read: " + std::generic_category().message(errno));
  }
}

AnimatedScene load_file(const std::string& source, const std::string* animation) {
  const std::filesystem::path file(source);
  check_readable(source, file);
  const Format& format = find_format(source, file);
  AnimatedScene scene =
      animation != nullptr && format.load == load_gltf ? load_animated_gltf(file, *animation) : AnimatedScene(format.load(file));
  if (scene.scene().name.empty()) scene.scene().name = file.filename().string();
  return scene;
}

// With its own time from 0 to 1, where it has one and is not asked for a certain one.
AnimatedScene make_builtin(const std::string& source, bool is_animated) {
  const std::string request = source.substr(kBuiltinPrefix.size());
  const std::string name = request.substr(0, request.find('?'));
  const std::vector<std::string> moving = moving_builtin_scenes();
  const bool moves = std::ranges::find(moving, name) != moving.end() && request.find("time=") == std::string::npos;
  if (!is_animated || !moves) return AnimatedScene(make_builtin_scene(request));
  const std::string timed = request + (request.find('?') == std::string::npos ? "?" : "&") + "time=";
  return {[timed](double time) { return make_builtin_scene(timed + std::to_string(time)); }, 0.0, 1.0};
}

// With the animation that is asked for, where one is.
AnimatedScene load(const std::string& source, const std::string* animation) {
  const Timer timer;
  try {
    AnimatedScene scene;
    if (source.starts_with(kBuiltinPrefix)) {
      scene = make_builtin(source, animation != nullptr);
      scene.scene().name = source;
    } else {
      scene = load_file(source, animation);
    }
    if (animation != nullptr && !animation->empty() && (!scene.animation() || source.starts_with(kBuiltinPrefix))) {
      throw UsageError("--animation: " + source + " has no animation '" + *animation + "'; it has none at all");
    }
    scene.scene().validate(source);
    scene.scene().load_seconds = timer.seconds();
    return scene;
  } catch (const std::bad_alloc&) {
    throw InputError(source, "", "does not fit into memory");
  }
}

}  // namespace

Scene load_scene(const std::string& source) {
  return std::move(load(source, nullptr).scene());
}

AnimatedScene load_animated_scene(const std::string& source, const std::string& choice) {
  return load(source, &choice);
}

}  // namespace grove

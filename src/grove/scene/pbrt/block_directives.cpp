#include <system_error>
#include <utility>

#include "grove/scene/pbrt/directives.h"

namespace grove::pbrt {
namespace {

constexpr std::array<std::string_view, 3> kBlockNames{"Attribute", "Transform", "Object"};

}  // namespace

void DirectiveReader::push(Block block) {
  saved_.push_back({block, state_, place_});
}

void DirectiveReader::pop(Block block) {
  const std::string name(kBlockNames[static_cast<std::size_t>(block)]);
  if (saved_.empty()) place_.fail(name + "End without " + name + "Begin");
  const SavedState& top = saved_.back();
  if (top.block != block)
    place_.fail(name + "End inside the " + std::string(kBlockNames[static_cast<std::size_t>(top.block)]) + "Begin of " + top.place.text());
  // TransformBegin keeps what other attributes became.
  if (block == Block::transform) {
    state_.transform = top.state.transform;
    state_.changes_start = top.state.changes_start;
  } else {
    state_ = top.state;
  }
  saved_.pop_back();
}

void DirectiveReader::object_begin() {
  std::string name = quoted_argument("the name of the object");
  if (in_object_) place_.fail("ObjectBegin inside another ObjectBegin");
  const auto [entry, is_new] = object_ids_.emplace(name, static_cast<std::uint32_t>(description_.objects.size()));
  if (!is_new) place_.fail("the object \"" + entry->first + "\" is defined twice");
  push(Block::object);
  in_object_ = true;
  description_.objects.push_back({std::move(name), {}});
}

void DirectiveReader::object_end() {
  if (!in_object_) place_.fail("ObjectEnd without ObjectBegin");
  pop(Block::object);
  in_object_ = false;
}

void DirectiveReader::object_instance() {
  std::string name = quoted_argument("the name of an object");
  if (in_object_) place_.fail("ObjectInstance inside an ObjectBegin; instances cannot be nested");
  note_world_content();
  description_.uses.push_back({std::move(name), place_, state_.transform});
}

void DirectiveReader::world_begin() {
  if (in_world_) place_.fail("WorldBegin for the second time");
  in_world_ = true;
  state_.transform = Matrix(1.0);
  state_.changes_start = true;
  coordinate_systems_["world"] = state_.transform;
}

std::filesystem::path DirectiveReader::included_file(const std::string& name) const {
  std::filesystem::path file = resolve_file(context_.directory, name);
  std::error_code error;
  if (std::filesystem::exists(file, error)) return file;
  // Not what pbrt does, but what authors of nested files tend to expect.
  const std::filesystem::path beside = resolve_file(std::filesystem::path(place_.file_name()).parent_path(), name);
  return std::filesystem::exists(beside, error) ? beside : file;
}

void DirectiveReader::include() {
  const std::string name = quoted_argument("the name of a file");
  read_file(included_file(name), Place(place_));
}

void DirectiveReader::import() {
  const std::string name = quoted_argument("the name of a file");
  // Unlike an included file, an imported one leaves the graphics state as it was.
  const GraphicsState before = state_;
  const std::size_t depth = saved_.size();
  const Place place = place_;
  read_file(included_file(name), place);
  if (saved_.size() != depth) place.fail("the imported file \"" + name + "\" does not end the blocks that it begins");
  state_ = before;
}

}  // namespace grove::pbrt

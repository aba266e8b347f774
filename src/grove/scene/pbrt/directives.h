#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "grove/scene/pbrt/context.h"
#include "grove/scene/pbrt/description.h"
#include "grove/scene/pbrt/graphics_state.h"
#include "grove/scene/pbrt/source_files.h"

namespace grove::pbrt {

/// Carries out the directives of a scene: keeps the graphics state and notes shapes, materials, textures and lights in a Description.
/// One scene, one reader, one thread.
class DirectiveReader {
 public:
  explicit DirectiveReader(Context& context);

  /// Reads a file to its end, with what it includes. Throws InputError naming file and line for text that is not a pbrt scene: unknown
  /// directives, blocks that do not match, includes that go round in a circle or too deep.
  void read_file(const std::filesystem::path& file, const Place& place);
  /// Warns of blocks left open and hands the result over.
  [[nodiscard]] Description finish() &&;

 private:
  using Handler = void (DirectiveReader::*)();
  static const std::map<std::string_view, Handler>& handlers();

  enum class Block : std::uint8_t { attribute, transform, object };
  struct SavedState {
    Block block;
    GraphicsState state;
    Place place;
  };

  // Arguments of the directive being read.
  std::string quoted_argument(std::string_view what);
  template <std::size_t kCount>
  std::array<double, kCount> number_arguments();
  ParameterList parameters(AttributeTarget target);
  ParameterList plain_parameters();

  // transform_directives.cpp
  void identity();
  void translate();
  void scale();
  void rotate();
  void look_at();
  void set_transform();
  void concatenate_transform();
  void coordinate_system();
  void coordinate_system_transform();
  void transform_times();
  void active_transform();
  void apply(const Matrix& matrix);

  // block_directives.cpp
  void attribute_begin() { push(Block::attribute); }
  void attribute_end() { pop(Block::attribute); }
  void transform_begin() { push(Block::transform); }
  void transform_end() { pop(Block::transform); }
  void object_begin();
  void object_end();
  void object_instance();
  void world_begin();
  void world_end() {}
  void include();
  void import();
  void push(Block block);
  void pop(Block block);
  [[nodiscard]] std::filesystem::path included_file(const std::string& name) const;

  // scene_directives.cpp
  void attribute();
  void reverse_orientation() { state_.reverse_orientation = !state_.reverse_orientation; }
  void colour_space();
  void ignored_setting();
  void option();
  void film();
  void camera();
  void material();
  void make_named_material();
  void named_material();
  void make_named_medium();
  void medium_interface();
  void texture();
  void light_source();
  void area_light_source();
  void shape();
  void note_world_content();

  Context& context_;
  Description description_;
  SourceFiles files_;
  Tokenizer* tokens_ = nullptr;  // of the file being read
  Token directive_;
  Place place_;  // of directive_
  GraphicsState state_;
  std::vector<SavedState> saved_;
  std::map<std::string, Matrix, std::less<>> coordinate_systems_;
  std::map<std::string, std::uint32_t, std::less<>> object_ids_;
  bool in_object_ = false;
  bool in_world_ = false;
};

}  // namespace grove::pbrt

#include "grove/scene/pbrt/directives.h"

#include <utility>

#include "grove/scene/pbrt/numbers.h"

namespace grove::pbrt {

DirectiveReader::DirectiveReader(Context& context) : context_(context) {
  description_.materials.push_back({.name = {}, .type = "diffuse", .parameters = {}, .later_name = {}});
}

const std::map<std::string_view, DirectiveReader::Handler>& DirectiveReader::handlers() {
  using Reader = DirectiveReader;
  static const std::map<std::string_view, Handler> kHandlers{
      {"Accelerator", &Reader::ignored_setting},
      {"ActiveTransform", &Reader::active_transform},
      {"AreaLightSource", &Reader::area_light_source},
      {"Attribute", &Reader::attribute},
      {"AttributeBegin", &Reader::attribute_begin},
      {"AttributeEnd", &Reader::attribute_end},
      {"Camera", &Reader::camera},
      {"ColorSpace", &Reader::colour_space},
      {"ConcatTransform", &Reader::concatenate_transform},
      {"CoordSysTransform", &Reader::coordinate_system_transform},
      {"CoordinateSystem", &Reader::coordinate_system},
      {"Film", &Reader::film},
      {"Identity", &Reader::identity},
      {"Import", &Reader::import},
      {"Include", &Reader::include},
      {"Integrator", &Reader::ignored_setting},
      {"LightSource", &Reader::light_source},
      {"LookAt", &Reader::look_at},
      {"MakeNamedMaterial", &Reader::make_named_material},
      {"MakeNamedMedium", &Reader::make_named_medium},
      {"Material", &Reader::material},
      {"MediumInterface", &Reader::medium_interface},
      {"NamedMaterial", &Reader::named_material},
      {"ObjectBegin", &Reader::object_begin},
      {"ObjectEnd", &Reader::object_end},
      {"ObjectInstance", &Reader::object_instance},
      {"Option", &Reader::option},
      {"PixelFilter", &Reader::ignored_setting},
      {"ReverseOrientation", &Reader::reverse_orientation},
      {"Rotate", &Reader::rotate},
      {"Sampler", &Reader::ignored_setting},
      {"Scale", &Reader::scale},
      {"Shape", &Reader::shape},
      {"SurfaceIntegrator", &Reader::ignored_setting},
      {"Texture", &Reader::texture},
      {"Transform", &Reader::set_transform},
      {"TransformBegin", &Reader::transform_begin},
      {"TransformEnd", &Reader::transform_end},
      {"TransformTimes", &Reader::transform_times},
      {"Translate", &Reader::translate},
      {"VolumeIntegrator", &Reader::ignored_setting},
      {"WorldBegin", &Reader::world_begin},
      {"WorldEnd", &Reader::world_end},
  };
  return kHandlers;
}

void DirectiveReader::read_file(const std::filesystem::path& file, const Place& place) {
  const std::unique_ptr<Tokenizer> tokens = files_.open(file, place);
  Tokenizer* const outer = std::exchange(tokens_, tokens.get());
  for (;;) {
    directive_ = tokens_->next();
    place_ = tokens_->place(directive_);
    if (directive_.kind == TokenKind::end) break;
    const std::string text(directive_.text.substr(0, 60));
    if (directive_.kind != TokenKind::word) place_.fail("expected a directive such as Shape or Translate, found \"" + text + "\"");
    const auto handler = handlers().find(directive_.text);
    if (handler == handlers().end()) place_.fail("unknown directive \"" + text + "\"");
    (this->*handler->second)();
  }
  tokens_ = outer;
  files_.close();
}

Description DirectiveReader::finish() && {
  for (const SavedState& open : saved_) {
    if (open.block == Block::object) open.place.fail("ObjectBegin without ObjectEnd");
    context_.warnings.add(open.place, "a block that begins here is not ended; add AttributeEnd");
  }
  return std::move(description_);
}

std::string DirectiveReader::quoted_argument(std::string_view what) {
  const Token token = tokens_->next();
  if (token.kind != TokenKind::quoted) place_.fail(std::string(directive_.text) + " takes " + std::string(what) + " in quotes");
  return std::string(token.text);
}

ParameterList DirectiveReader::plain_parameters() {
  ParameterList list = parse_parameters(*tokens_, place_);
  list.set_colour_space(state_.colour_space);
  return list;
}

ParameterList DirectiveReader::parameters(AttributeTarget target) {
  ParameterList list = plain_parameters();
  if (state_.defaults != nullptr) list.set_defaults((*state_.defaults)[static_cast<std::size_t>(target)]);
  return list;
}

}  // namespace grove::pbrt

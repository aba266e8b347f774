#include "grove/render/saved/film_header_json.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <span>

#include "grove/base/error.h"
#include "grove/render/render.h"

namespace grove {
namespace {

using Json = nlohmann::ordered_json;

std::uint32_t number(const Json& json, const char* key) {
  const Json& value = json.at(key);
  const auto wide = value.is_number_unsigned() ? value.get<std::uint64_t>() : std::uint64_t{UINT64_MAX};
  if (wide > UINT32_MAX) throw InputError(std::string("'") + key + "' is no whole number of 32 bits");
  return static_cast<std::uint32_t>(wide);
}

/// Throws exceptions of the JSON library too.
FilmHeader parse(std::string_view text) {
  const Json json = Json::parse(text);
  FilmHeader header;
  header.scene = json.at("scene").get<std::string>();
  header.width = number(json, "width");
  header.height = number(json, "height");
  header.samples_per_pixel = number(json, "samples_per_pixel");
  header.part.share = number(json.at("tiles"), "share");
  header.part.share_count = number(json.at("tiles"), "of");
  header.part.first_sample = number(json.at("samples"), "first");
  header.part.end_sample = number(json.at("samples"), "end");
  const Json& noise = json.at("noise");
  header.noise.target = noise.at("target").get<float>();
  header.noise.min_samples = number(noise, "min_samples");
  header.noise.floor = noise.at("floor").get<float>();
  header.is_finished = json.at("finished").get<bool>();
  header.rays_traced = json.at("rays").get<std::uint64_t>();
  header.seconds = json.at("seconds").get<double>();
  for (const auto& [name, value] : json.at("picture").items()) header.picture.facts.push_back({name, value.get<std::string>()});
  return header;
}

void check(const FilmHeader& header) {
  if (!TileGrid::is_possible(header.width, header.height)) {
    throw InputError(std::to_string(header.width) + " x " + std::to_string(header.height) + " pixels are no picture");
  }
  if (fact_of(header.picture, "width") != std::to_string(header.width) ||
      fact_of(header.picture, "height") != std::to_string(header.height)) {
    throw InputError("the picture is of two sizes");
  }
  const std::span<const std::string_view> integrators = integrator_names();
  if (std::ranges::find(integrators, fact_of(header.picture, "integrator")) == integrators.end()) {
    throw InputError("the picture is of an unknown integrator");
  }
  const PicturePart& part = header.part;
  const TileGrid grid(header.width, header.height);
  if (part.share >= part.share_count || part.share >= grid.count() || part.first_sample >= part.end_sample ||
      part.end_sample > header.samples_per_pixel) {
    throw InputError("'" + part.text() + "' is no part of the picture");
  }
  if (!(header.noise.target >= 0.0F) || !(header.noise.floor > 0.0F)) throw InputError("a noise target cannot be like that");
}

}  // namespace

std::string film_header_json(const FilmHeader& header) {
  Json picture = Json::object();
  for (const PictureIdentity::Fact& fact : header.picture.facts) picture[fact.name] = fact.value;
  const Json json{{"scene", header.scene},
                  {"width", header.width},
                  {"height", header.height},
                  {"samples_per_pixel", header.samples_per_pixel},
                  {"tiles", {{"share", header.part.share}, {"of", header.part.share_count}}},
                  {"samples", {{"first", header.part.first_sample}, {"end", header.part.end_sample}}},
                  {"noise", {{"target", header.noise.target}, {"min_samples", header.noise.min_samples}, {"floor", header.noise.floor}}},
                  {"finished", header.is_finished},
                  {"rays", header.rays_traced},
                  {"seconds", header.seconds},
                  {"picture", picture}};
  // File names need not be text.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

FilmHeader film_header_from_json(std::string_view json, std::string_view file) {
  try {
    FilmHeader header = parse(json);
    check(header);
    return header;
  } catch (const InputError& error) {
    throw InputError(file, "header", error.what());
  } catch (const Json::exception& error) {
    throw InputError(file, "header", error.what());
  }
}

}  // namespace grove

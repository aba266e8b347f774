#include "grove/scene/gltf/document.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "grove/base/error.h"
#include "grove/scene/gltf/container.h"
#include "grove/scene/gltf/uri.h"
#include "grove/scene/read_file.h"

namespace grove {
namespace {

// The format itself needs about ten levels, `extras` may nest at will; each level costs memory out of proportion to its one byte.
constexpr int kDeepestJson = 100;

// A file may grow in memory: indices from one byte to four, attributes from one byte to four, Draco about twenty times. Where arrays
// are shared there is no bound by nature, so this one is set where no real file comes near.
constexpr std::uint64_t kGrowth = 64;
constexpr std::uint64_t kFreeBytes = std::uint64_t{16} << 20;

constexpr std::array<std::string_view, 17> kKnownExtensions{"KHR_draco_mesh_compression",
                                                            "KHR_lights_punctual",
                                                            "KHR_materials_clearcoat",
                                                            "KHR_materials_emissive_strength",
                                                            "KHR_materials_ior",
                                                            "KHR_materials_sheen",
                                                            "KHR_materials_specular",
                                                            "KHR_materials_transmission",
                                                            "KHR_materials_volume",
                                                            "KHR_materials_pbrSpecularGlossiness",
                                                            "KHR_materials_unlit",
                                                            "KHR_materials_variants",
                                                            "KHR_mesh_quantization",
                                                            "KHR_texture_transform",
                                                            "EXT_mesh_gpu_instancing",
                                                            "KHR_xmp_json_ld",
                                                            "KHR_xmp"};

bool is_known(std::string_view extension) {
  return std::find(kKnownExtensions.begin(), kKnownExtensions.end(), extension) != kKnownExtensions.end();
}

// Reads "parse error at line 1, column 5: …" from nlohmann's "[json.exception.parse_error.101] parse error at line 1, column 5: …".
std::string plain_message(const nlohmann::json::exception& error) {
  // It may quote a whole string of the file.
  constexpr std::size_t kLongest = 200;
  const std::string message = error.what();
  const std::size_t end = message.find("] ");
  return message.substr(end == std::string::npos ? 0 : end + 2, kLongest);
}

// Brackets of JSON text, outside strings. The parser's own callback could count them too, but takes quadratic time.
int nesting_depth(std::string_view text) {
  int depth = 0;
  int deepest = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (in_string) {
      if (c == '\\') ++i;
      if (c == '"') in_string = false;
    } else if (c == '"') {
      in_string = true;
    } else if (c == '[' || c == '{') {
      deepest = std::max(deepest, ++depth);
    } else if (c == ']' || c == '}') {
      --depth;
    }
  }
  return deepest;
}

nlohmann::json parse_json(std::string_view text, const std::string& file) {
  if (nesting_depth(text) > kDeepestJson) {
    throw InputError(file, "", "JSON nested deeper than " + std::to_string(kDeepestJson) + " levels");
  }
  try {
    return nlohmann::json::parse(text);
  } catch (const nlohmann::json::exception& error) {
    throw InputError(file, "", "not a glTF file that can be read: " + plain_message(error));
  }
}

}  // namespace

GltfDocument::GltfDocument(const std::filesystem::path& file)
    : file_(file.string()), json_(std::make_unique<nlohmann::json>()), root_(*json_, file_) {
  const std::vector<std::byte> data = read_file(file);
  bytes_read_ = data.size();
  const GltfContainer container = split_container(data, file_);
  *json_ = parse_json(container.json, file_);
  if (container.binary) binary_.emplace(container.binary->begin(), container.binary->end());
  if (!json_->is_object()) throw InputError(file_, "", "not a glTF file: the JSON is not an object");
  check_asset();
  check_extensions();
  buffers_.resize(array("buffers").size());
}

GltfDocument::~GltfDocument() = default;

void GltfDocument::check_asset() const {
  const JsonCursor version = root_["asset"]["version"];
  if (!version.exists()) version.fail("is missing; is this a glTF file?");
  if (!version.text().starts_with("2.")) version.fail("is " + version.text().substr(0, 16) + "; glTF 2.x is read");
}

void GltfDocument::check_extensions() const {
  const JsonCursor required = root_["extensionsRequired"];
  for (std::size_t i = 0; i < required.size(); ++i) {
    const std::string name = required.element(i).text();
    if (!is_known(name)) required.element(i).fail(name + " is required but not supported; export the scene without it");
  }
}

std::vector<std::string> ignored_extensions(const GltfDocument& document) {
  std::vector<std::string> ignored;
  const JsonCursor used = document.root()["extensionsUsed"];
  for (std::size_t i = 0; i < used.size(); ++i) {
    std::string name = used.element(i).text();
    if (!is_known(name)) ignored.push_back(std::move(name));
  }
  return ignored;
}

std::vector<std::byte> GltfDocument::read_uri(const JsonCursor& place) {
  const std::string uri = place.text();
  // A data URI is part of the file, whose bytes are counted already.
  if (auto bytes = decode_data_uri(uri, file_, place.path())) return std::move(*bytes);
  const std::filesystem::path named = resolve_uri(uri, file_, place.path());
  try {
    std::vector<std::byte> bytes = read_file(named);
    bytes_read_ += bytes.size();
    return bytes;
  } catch (const InputError& error) {
    place.fail(error.what());
  }
}

const std::vector<std::byte>& GltfDocument::buffer(std::uint32_t id) {
  std::optional<std::vector<std::byte>>& slot = buffers_[id];
  if (slot) return *slot;
  const JsonCursor description = array("buffers").element(id);
  const std::uint64_t length = description["byteLength"].whole();
  std::vector<std::byte> bytes;
  if (description["uri"].exists()) {
    bytes = read_uri(description["uri"]);
  } else if (id == 0 && binary_) {
    bytes = std::move(*binary_);
  } else {
    description.fail("has no uri, and there is no binary chunk for it");
  }
  if (bytes.size() < length) {
    description["byteLength"].fail("is " + std::to_string(length) + ", but there are only " + std::to_string(bytes.size()) + " bytes");
  }
  // A GLB's chunk is padded to four bytes; what lies beyond the length is not part of the buffer.
  bytes.resize(length);
  return slot.emplace(std::move(bytes));
}

std::span<const std::byte> GltfDocument::view(std::uint32_t id) {
  const JsonCursor views = array("bufferViews");
  if (id >= views.size()) views.fail("has no number " + std::to_string(id));
  const JsonCursor description = views.element(id);
  const std::vector<std::byte>& bytes = buffer(description["buffer"].required_index(buffers_.size(), "buffers"));
  const std::uint64_t offset = description["byteOffset"].whole(0);
  const std::uint64_t length = description["byteLength"].whole();
  if (offset > bytes.size() || length > bytes.size() - offset) {
    description.fail("reaches past the end of its buffer of " + std::to_string(bytes.size()) + " bytes");
  }
  return std::span(bytes).subspan(offset, length);
}

void GltfDocument::charge(std::uint64_t bytes, const JsonCursor& place) {
  charged_ += bytes;
  if (charged_ > kFreeBytes + kGrowth * bytes_read_) {
    place.fail("the file would grow to more than " + std::to_string(kGrowth) + " times its size in memory; it uses its arrays too often");
  }
}

}  // namespace grove

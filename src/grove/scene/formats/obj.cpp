#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <sstream>
#include <unordered_map>
#include <utility>

#include "grove/base/error.h"
#include "grove/base/random.h"
#include "grove/scene/formats/mesh_scene.h"
#include "grove/scene/formats/mtl.h"
#include "grove/scene/formats/obj_parser.h"
#include "grove/scene/formats/text.h"
#include "grove/scene/load.h"

namespace grove {
namespace {

struct CornerHash {
  std::size_t operator()(const ObjCorner& c) const { return mix_bits(mix_bits((std::uint64_t{c.position} << 32) | c.uv) ^ c.normal); }
};

/// The arrays of one part; corners that agree in position, texture coordinate and normal become one vertex.
struct PartArrays {
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;
  Part part;
};

PartArrays build_part(const ObjFile& obj, const ObjPart& source) {
  bool has_uvs = false;
  bool has_normals = false;
  for (const auto& triangle : source.triangles) {
    for (const ObjCorner& corner : triangle) {
      has_uvs = has_uvs || corner.uv != kNoObjIndex;
      has_normals = has_normals || corner.normal != kNoObjIndex;
    }
  }

  PartArrays arrays;
  arrays.triangles.reserve(source.triangles.size());
  std::unordered_map<ObjCorner, std::uint32_t, CornerHash> ids;
  ids.reserve(source.triangles.size());
  for (const auto& corners : source.triangles) {
    Triangle triangle(0);
    for (int i = 0; i < 3; ++i) {
      const ObjCorner& corner = corners[static_cast<std::size_t>(i)];
      const auto [entry, is_new] = ids.try_emplace(corner, static_cast<std::uint32_t>(arrays.vertices.size()));
      triangle[i] = entry->second;
      if (!is_new) continue;
      arrays.vertices.push_back(obj.positions[corner.position]);
      if (!obj.colours.empty()) arrays.part.colours.push_back(obj.colours[corner.position]);
      if (has_uvs) arrays.part.uvs.push_back(corner.uv == kNoObjIndex ? Vec2(0.0F) : obj.uvs[corner.uv]);
      // A zero normal is mended below.
      if (has_normals) arrays.part.normals.push_back(corner.normal == kNoObjIndex ? Vec3(0.0F) : obj.normals[corner.normal]);
    }
    arrays.triangles.push_back(triangle);
  }
  return arrays;
}

// One name may contain spaces, or be several names: the whole is tried first.
void load_libraries(const std::filesystem::path& folder, const ObjFile& obj, Scene& scene, std::map<std::string, std::uint32_t>& ids) {
  for (std::string line : obj.material_libraries) {
    std::replace(line.begin(), line.end(), '\\', '/');
    std::vector<std::string> names{line};
    std::error_code error;
    if (!std::filesystem::exists(folder / line, error) && line.find(' ') != std::string::npos) {
      std::istringstream words(line);
      names.clear();
      for (std::string name; words >> name;) names.push_back(name);
    }
    for (const std::string& name : names) {
      try {
        load_mtl(folder / name, scene, ids);
      } catch (const InputError& failure) {
        scene.warn(std::string("a material library is left out: ") + failure.what());
      }
    }
  }
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

}  // namespace

Scene load_obj(const std::filesystem::path& file) {
  ObjFile obj = parse_obj(file);
  if (obj.parts.empty()) {
    throw InputError(file.string(), "", "nothing renderable: " + std::to_string(obj.positions.size()) + " vertices but no faces");
  }
  Scene scene;
  if (!obj.ignored.empty()) scene.warn("lines that are no part of a mesh were left out: " + joined(obj.ignored));
  std::map<std::string, std::uint32_t> material_ids;
  load_libraries(file.parent_path(), obj, scene, material_ids);

  std::uint32_t default_id = kNoTexture;
  std::vector<std::string> undefined;
  std::size_t dropped = 0;
  auto mesh = std::make_shared<TriangleMesh>();
  Object object;
  object.name = file.stem().string();
  for (ObjPart& source : obj.parts) {
    PartArrays arrays = build_part(obj, source);
    source.triangles = {};
    dropped += drop_unhittable(arrays.vertices, arrays.triangles);
    mend_normals(arrays.vertices, arrays.triangles, arrays.part.normals);
    arrays.part.name = source.shape;
    const auto known = material_ids.find(source.material);
    if (known != material_ids.end()) {
      arrays.part.material = known->second;
    } else {
      if (default_id == kNoTexture) {
        default_id = static_cast<std::uint32_t>(scene.materials.size());
        scene.materials.push_back(default_material());
      }
      arrays.part.material = default_id;
      const std::string name = quote(source.material);
      const bool is_new = std::find(undefined.begin(), undefined.end(), name) == undefined.end();
      if (!source.material.empty() && is_new) undefined.push_back(name);
    }
    mesh->add_part(std::move(arrays.vertices), std::move(arrays.triangles));
    object.parts.push_back(std::move(arrays.part));
  }
  if (!undefined.empty()) scene.warn("materials that no library defines are grey: " + joined(undefined));
  if (dropped > 0) scene.warn(unhittable_warning(dropped));
  object.geometry = std::move(mesh);
  scene.objects.push_back(std::move(object));
  scene.instances.push_back({.name = scene.objects[0].name, .object = 0, .object_to_world = Transform()});
  return scene;
}

}  // namespace grove

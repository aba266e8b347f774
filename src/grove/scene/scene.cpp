#include "grove/scene/scene.h"

#include <algorithm>
#include <string_view>

#include "grove/base/error.h"
#include "grove/base/parallel.h"

namespace grove {
namespace {

constexpr std::uint32_t kNoImage = 0xffffffffU;
// Large enough that a chunk's bounds cost far more than handing the chunk out.
constexpr std::size_t kBoundsChunk = 1U << 16;

template <typename Geometry>
Box geometry_bounds(const Geometry& geometry) {
  std::vector<Box> chunks((geometry.size() + kBoundsChunk - 1) / kBoundsChunk);
  parallel_chunks(geometry.size(), kBoundsChunk, [&](std::size_t id, std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) chunks[id].grow(geometry.bounds(i));
  });
  Box bounds;
  for (const Box& chunk : chunks) bounds.grow(chunk);
  return bounds;
}

Box object_bounds(const Object& object) {
  return std::visit([](const auto& geometry) { return geometry_bounds(*geometry); }, object.geometry);
}

// Stops at the first primitive that can be hit, which is nearly always the very first.
bool can_be_hit(const Object& object) {
  return std::visit(
      [](const auto& geometry) {
        for (std::size_t i = 0; i < geometry->size(); ++i) {
          if (!geometry->bounds(i).is_empty()) return true;
        }
        return false;
      },
      object.geometry);
}

/// Collects the checks of one scene; each throws InputError naming the file and the thing that is wrong.
class Validator {
 public:
  Validator(const Scene& scene, std::string_view file) : scene_(scene), file_(file) {}

  void run() const {
    check_textures();
    check_materials();
    check_environment();
    check_objects();
    check_instances();
  }

 private:
  void require(bool holds, std::string_view what, std::size_t number, std::string_view problem) const {
    if (holds) return;
    throw InputError(file_, std::string(what) + " " + std::to_string(number), problem);
  }

  [[nodiscard]] bool is_texture(std::uint32_t id) const { return id == kNoTexture || id < scene_.textures.size(); }

  void check_textures() const {
    for (std::size_t i = 0; i < scene_.textures.size(); ++i) {
      const Texture& texture = scene_.textures[i];
      require(texture.kind != TextureKind::image || texture.image < scene_.images.size(), "texture", i, "names an image that is not there");
      for (const std::uint32_t operand : {texture.operand[0], texture.operand[1], texture.amount_texture}) {
        require(operand == kNoTexture || operand < i, "texture", i, "has an operand that does not come before it");
      }
    }
    for (std::size_t i = 0; i < scene_.images.size(); ++i) {
      require(scene_.images[i] != nullptr, "image", i, "is missing");
      const Image& image = *scene_.images[i];
      const std::size_t values = std::size_t{image.width} * image.height * image.channels;
      require(values > 0 && (image.is_float() ? image.floats.size() : image.bytes.size()) == values, "image", i,
              "has a size that does not agree with its pixels");
    }
  }

  void check_materials() const {
    for (std::size_t i = 0; i < scene_.materials.size(); ++i) {
      const Material& m = scene_.materials[i];
      for (const std::uint32_t texture :
           {m.base_colour.texture, m.transmission_colour.texture, m.emission.texture, m.metallic.texture, m.roughness.texture,
            m.coat_roughness.texture, m.transmission.texture, m.bump.texture, m.alpha.texture, m.mix_amount.texture, m.normal_texture,
            m.specular.texture, m.specular_colour.texture, m.coat.texture, m.coat_normal_texture, m.sheen_colour.texture,
            m.sheen_roughness.texture}) {
        require(is_texture(texture), "material", i, "names a texture that is not there");
      }
      require(m.kind != MaterialKind::mix || (m.mix_material[0] < i && m.mix_material[1] < i), "material", i,
              "mixes a material that does not come before it");
    }
  }

  void check_environment() const {
    const std::uint32_t image = scene_.environment.image;
    if (image != kNoImage && image >= scene_.images.size()) {
      throw InputError(file_, "environment", "names an image that is not there");
    }
  }

  void check_objects() const {
    for (std::size_t i = 0; i < scene_.objects.size(); ++i) {
      const Object& object = scene_.objects[i];
      std::visit(
          [&](const auto& geometry) {
            require(geometry != nullptr, "object", i, "has no geometry");
            require(geometry->part_count() == object.parts.size(), "object", i, "has more or fewer materials than parts");
            for (std::uint32_t part = 0; part < object.parts.size(); ++part) {
              check_part(i, object.parts[part], vertex_count(*geometry, part));
            }
          },
          object.geometry);
    }
  }

  // Attributes are per vertex, so spheres have none.
  static std::size_t vertex_count(const SphereSet& /*spheres*/, std::uint32_t /*part*/) { return 0; }
  static std::size_t vertex_count(const TriangleMesh& mesh, std::uint32_t part) {
    const std::size_t end = part + 1 < mesh.part_count() ? mesh.first_vertex(part + 1) : mesh.vertices().size();
    return end - mesh.first_vertex(part);
  }

  void check_part(std::size_t object, const Part& part, std::size_t vertex_count) const {
    require(part.material < scene_.materials.size(), "object", object, "names a material that is not there");
    for (const std::size_t count :
         {part.normals.size(), part.uvs.size(), part.second_uvs.size(), part.tangents.size(), part.colours.size()}) {
      require(count == 0 || count == vertex_count, "object", object, "has vertex attributes for some vertices only");
    }
  }

  void check_instances() const {
    for (std::size_t i = 0; i < scene_.instances.size(); ++i) {
      require(scene_.instances[i].object < scene_.objects.size(), "instance", i, "names an object that is not there");
    }
    const bool renderable = std::any_of(scene_.instances.begin(), scene_.instances.end(), [&](const Instance& instance) {
      return instance.object_to_world.is_invertible() && can_be_hit(scene_.objects[instance.object]);
    });
    if (!renderable) throw InputError(file_, "", "nothing renderable: no triangle or sphere that a ray could hit");
  }

  const Scene& scene_;
  std::string_view file_;
};

}  // namespace

std::uint64_t Scene::primitive_count() const {
  std::uint64_t count = 0;
  for (const Instance& instance : instances) count += objects[instance.object].primitive_count();
  return count;
}

std::uint64_t Scene::stored_primitive_count() const {
  std::uint64_t count = 0;
  for (const Object& object : objects) count += object.primitive_count();
  return count;
}

Box Scene::bounds() const {
  std::vector<Box> local(objects.size());
  for (std::size_t i = 0; i < objects.size(); ++i) local[i] = object_bounds(objects[i]);
  Box bounds;
  for (const Instance& instance : instances) {
    if (!instance.object_to_world.is_invertible()) continue;
    bounds.grow(instance.object_to_world.box(local[instance.object]));
  }
  return bounds;
}

void Scene::warn(std::string line) {
  if (std::find(warnings.begin(), warnings.end(), line) == warnings.end()) warnings.push_back(std::move(line));
}

void Scene::validate(std::string_view file) const {
  Validator(*this, file).run();
}

}  // namespace grove

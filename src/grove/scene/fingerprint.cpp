#include "grove/scene/fingerprint.h"

#include <algorithm>
#include <span>
#include <vector>

#include "grove/base/hash.h"
#include "grove/base/parallel.h"

// Each structure is taken apart by a structured binding, which no longer compiles when a member is added: so none is forgotten.

namespace grove {
namespace {

/// Bytes that one task hashes: much against the cost of a task, little against a large mesh.
constexpr std::size_t kChunk = std::size_t{1} << 20;

template <typename T>
void add_array(Hash& hash, std::span<const T> values) {
  const std::span<const std::byte> bytes = std::as_bytes(values);
  std::vector<std::uint64_t> chunks((bytes.size() + kChunk - 1) / kChunk);
  parallel_chunks(bytes.size(), kChunk, [&](std::size_t chunk, std::size_t first, std::size_t last) {
    Hash part;
    part.add_all(bytes.subspan(first, last - first));
    chunks[chunk] = part.value();
  });
  hash.add(bytes.size());
  hash.add_all(std::span<const std::uint64_t>(chunks));
}

template <typename T>
void add_array(Hash& hash, const std::vector<T>& values) {
  add_array(hash, std::span<const T>(values));
}

void add_geometry(Hash& hash, const TriangleMesh& mesh) {
  add_array(hash, mesh.vertices());
  add_array(hash, mesh.triangles());
  for (std::uint32_t part = 0; part < mesh.part_count(); ++part) {
    hash.add(mesh.first_triangle(part));
    hash.add(mesh.first_vertex(part));
  }
}

void add_geometry(Hash& hash, const SphereSet& set) {
  static_assert(sizeof(SphereSet::Sphere) == 4 * sizeof(float));
  std::vector<SphereSet::Sphere> spheres;
  spheres.reserve(set.size());
  for (std::size_t i = 0; i < set.size(); ++i) spheres.push_back(set.sphere(i));
  add_array(hash, spheres);
  for (std::uint32_t part = 0; part < set.part_count(); ++part) hash.add(set.first_sphere(part));
}

void add_object(Hash& hash, const Object& object) {
  const auto& [object_name, geometry, parts] = object;
  hash.add(geometry.index());
  std::visit([&](const auto& set) { add_geometry(hash, *set); }, geometry);
  for (const Part& part : parts) {
    const auto& [name, material, normals, uvs, second_uvs, tangents, colours, flip_orientation] = part;
    hash.add(material);
    add_array(hash, normals);
    add_array(hash, uvs);
    add_array(hash, second_uvs);
    add_array(hash, tangents);
    add_array(hash, colours);
    hash.add(flip_orientation);
  }
}

void add_parameter(Hash& hash, const ColourParameter& parameter) {
  const auto& [value, texture] = parameter;
  hash.add(value);
  hash.add(texture);
}

void add_parameter(Hash& hash, const ScalarParameter& parameter) {
  const auto& [value, texture, channel] = parameter;
  hash.add(value);
  hash.add(texture);
  hash.add(channel);
}

void add_material(Hash& hash, const Material& material) {
  const auto& [name, kind, base_colour, metallic, roughness, coat_roughness, ior, specular, specular_colour, coat, coat_normal_texture,
               coat_normal_scale, sheen_colour, sheen_roughness, transmission_colour, transmission, thin_walled, attenuation_colour,
               attenuation_distance, has_complex_ior, ior_colour, absorption, normal_texture, normal_scale, bump, alpha_mode, alpha,
               alpha_cutoff, emission, two_sided_emission, emits_vertex_colour, mix_material, mix_amount] = material;
  for (const ColourParameter* colour : {&base_colour, &specular_colour, &sheen_colour, &transmission_colour, &emission}) {
    add_parameter(hash, *colour);
  }
  for (const ScalarParameter* scalar :
       {&metallic, &roughness, &coat_roughness, &specular, &coat, &sheen_roughness, &transmission, &bump, &alpha, &mix_amount}) {
    add_parameter(hash, *scalar);
  }
  hash.add(coat_normal_texture);
  hash.add(coat_normal_scale);
  hash.add(attenuation_colour);
  hash.add(attenuation_distance);
  hash.add(emits_vertex_colour);
  hash.add(kind);
  hash.add(ior);
  hash.add(thin_walled);
  hash.add(has_complex_ior);
  hash.add(ior_colour);
  hash.add(absorption);
  hash.add(normal_texture);
  hash.add(normal_scale);
  hash.add(alpha_mode);
  hash.add(alpha_cutoff);
  hash.add(two_sided_emission);
  hash.add_all(std::span<const std::uint32_t>(mix_material));
}

void add_texture(Hash& hash, const Texture& texture) {
  const auto& [name, kind, image, srgb, invert, wrap_u, wrap_v, filter, uv_set, uv_transform, operand, value, amount_texture, amount] =
      texture;
  hash.add(kind);
  hash.add(image);
  hash.add(srgb);
  hash.add(invert);
  hash.add(wrap_u);
  hash.add(wrap_v);
  hash.add(filter);
  hash.add(uv_set);
  hash.add(uv_transform);
  hash.add_all(std::span<const std::uint32_t>(operand));
  hash.add_all(std::span<const Vec4>(value));
  hash.add(amount_texture);
  hash.add(amount);
}

void add_image(Hash& hash, const Image& image) {
  const auto& [name, width, height, channels, bytes, floats] = image;
  hash.add(width);
  hash.add(height);
  hash.add(channels);
  add_array(hash, bytes);
  add_array(hash, floats);
}

void add_light(Hash& hash, const PunctualLight& light) {
  const auto& [name, kind, position, direction, intensity, inner_angle, outer_angle, range] = light;
  hash.add(kind);
  hash.add(position);
  hash.add(direction);
  hash.add(intensity);
  hash.add(inner_angle);
  hash.add(outer_angle);
  hash.add(range);
}

void add_environment(Hash& hash, const Environment& environment) {
  const auto& [radiance, image, mapping, world_to_environment] = environment;
  hash.add(radiance);
  hash.add(image);
  hash.add(mapping);
  hash.add(world_to_environment);
}

}  // namespace

std::uint64_t fingerprint(const Scene& scene) {
  const auto& [name, objects, instances, materials, textures, images, lights, environment, cameras, film, warnings, load_seconds] = scene;
  Hash hash;
  for (const std::size_t count : {objects.size(), instances.size(), materials.size(), textures.size(), images.size(), lights.size()}) {
    hash.add(count);
  }
  for (const Object& object : objects) add_object(hash, object);
  for (const Instance& instance : instances) {
    const auto& [instance_name, object, object_to_world] = instance;
    hash.add(object);
    hash.add(object_to_world.matrix());
  }
  for (const Material& material : materials) add_material(hash, material);
  for (const Texture& texture : textures) add_texture(hash, texture);
  for (const auto& image : images) add_image(hash, *image);
  for (const PunctualLight& light : lights) add_light(hash, light);
  add_environment(hash, environment);
  return hash.value();
}

}  // namespace grove

#include "grove/scene/gltf/accessors.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>

namespace grove {
namespace {

static_assert(std::endian::native == std::endian::little, "glTF is little-endian, and components are copied as they are");

enum class ComponentType : std::uint16_t { int8 = 5120, uint8 = 5121, int16 = 5122, uint16 = 5123, uint32 = 5125, float32 = 5126 };

std::size_t size_of(ComponentType type) {
  switch (type) {
    case ComponentType::int8:
    case ComponentType::uint8:
      return 1;
    case ComponentType::int16:
    case ComponentType::uint16:
      return 2;
    case ComponentType::uint32:
    case ComponentType::float32:
      break;
  }
  return 4;
}

bool is_unsigned(ComponentType type) {
  return type == ComponentType::uint8 || type == ComponentType::uint16 || type == ComponentType::uint32;
}

ComponentType read_component_type(const JsonCursor& place) {
  const std::uint64_t code = place.whole();
  if (code < 5120 || code > 5126 || code == 5124) place.fail("is " + std::to_string(code) + ", not a component type");
  return static_cast<ComponentType>(code);
}

unsigned component_count(const JsonCursor& place) {
  const std::string type = place.text();
  if (type == "SCALAR") return 1;
  if (type == "VEC2") return 2;
  if (type == "VEC3") return 3;
  if (type == "VEC4") return 4;
  if (type == "MAT4") return 16;
  place.fail("is not a type that is used here");
}

template <typename T>
T load(const std::byte* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof(value));
  return value;
}

std::uint32_t load_integer(const std::byte* bytes, ComponentType type) {
  switch (type) {
    case ComponentType::uint8:
      return load<std::uint8_t>(bytes);
    case ComponentType::uint16:
      return load<std::uint16_t>(bytes);
    default:
      return load<std::uint32_t>(bytes);
  }
}

// The formulas for normalised integers are those of glTF 2.0 section 3.11: the most negative integer is clamped.
float load_float(const std::byte* bytes, ComponentType type, bool normalised) {
  switch (type) {
    case ComponentType::int8: {
      const auto value = static_cast<float>(load<std::int8_t>(bytes));
      return normalised ? std::max(value / 127.0F, -1.0F) : value;
    }
    case ComponentType::uint8: {
      const auto value = static_cast<float>(load<std::uint8_t>(bytes));
      return normalised ? value / 255.0F : value;
    }
    case ComponentType::int16: {
      const auto value = static_cast<float>(load<std::int16_t>(bytes));
      return normalised ? std::max(value / 32767.0F, -1.0F) : value;
    }
    case ComponentType::uint16: {
      const auto value = static_cast<float>(load<std::uint16_t>(bytes));
      return normalised ? value / 65535.0F : value;
    }
    case ComponentType::uint32:
      return static_cast<float>(load<std::uint32_t>(bytes));
    case ComponentType::float32:
      break;
  }
  return load<float>(bytes);
}

template <typename Value>
void load_element(const std::byte* bytes, ComponentType type, bool normalised, unsigned components, Value& value) {
  const std::size_t step = size_of(type);
  for (unsigned c = 0; c < components; ++c) {
    const std::byte* source = bytes + c * step;
    if constexpr (std::is_same_v<Value, float>) {
      value = load_float(source, type, normalised);
    } else if constexpr (std::is_same_v<Value, std::uint32_t>) {
      value = load_integer(source, type);
    } else if constexpr (std::is_same_v<Value, glm::u32vec4>) {
      value[static_cast<int>(c)] = load_integer(source, type);
    } else if constexpr (std::is_same_v<Value, Mat4>) {
      value[static_cast<int>(c / 4)][static_cast<int>(c % 4)] = load_float(source, type, normalised);
    } else {
      value[static_cast<int>(c)] = load_float(source, type, normalised);
    }
  }
}

// What an accessor without a buffer view holds: zero bytes.
template <typename Value>
Value zero() {
  if constexpr (std::is_same_v<Value, Mat4>) return Mat4(0.0F);
  return Value(0);
}

// The bytes that `count` elements, `stride` apart, take from `offset` on, are inside `available`; written so that nothing can overflow.
bool fits(std::uint64_t count, std::uint64_t element, std::uint64_t stride, std::uint64_t offset, std::uint64_t available) {
  if (offset > available || element > available - offset) return count == 0;
  return count == 0 || (count - 1) <= (available - offset - element) / stride;
}

}  // namespace

/// An accessor's description, with the ranges checked.
struct GltfAccessors::Layout {
  explicit Layout(JsonCursor accessor) : place(std::move(accessor)) {}

  JsonCursor place;
  std::uint64_t count = 0;
  ComponentType type = ComponentType::float32;
  unsigned components = 1;
  bool normalised = false;
  /// From the first element on; empty when the accessor has no buffer view.
  std::span<const std::byte> bytes;
  std::size_t stride = 0;
};

GltfAccessors::Layout GltfAccessors::layout(const JsonCursor& place) const {
  const JsonCursor accessors = document_.array("accessors");
  Layout layout(accessors.element(place.required_index(accessors.size(), "accessors")));
  const JsonCursor& accessor = layout.place;
  layout.count = accessor["count"].whole();
  layout.type = read_component_type(accessor["componentType"]);
  layout.components = component_count(accessor["type"]);
  layout.normalised = accessor["normalized"].boolean(false);
  const JsonCursor view = accessor["bufferView"];
  if (!view.exists()) return layout;

  const JsonCursor views = document_.array("bufferViews");
  const std::uint32_t view_id = view.required_index(views.size(), "buffer views");
  const std::span<const std::byte> bytes = document_.view(view_id);
  const std::uint64_t offset = accessor["byteOffset"].whole(0);
  const std::size_t element = size_of(layout.type) * layout.components;
  layout.stride = views.element(view_id)["byteStride"].whole(element);
  if (layout.stride < element) views.element(view_id)["byteStride"].fail("is smaller than an element of accessor " + accessor.path());
  if (!fits(layout.count, element, layout.stride, offset, bytes.size())) {
    accessor.fail("its " + std::to_string(layout.count) + " elements reach past the end of a buffer view of " +
                  std::to_string(bytes.size()) + " bytes");
  }
  if (layout.count > 0) layout.bytes = bytes.subspan(offset);
  return layout;
}

template <typename Value>
void GltfAccessors::read_dense(const Layout& layout, const ElementSelection& elements, std::vector<Value>& values) const {
  if (layout.bytes.empty()) return;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::size_t id = elements.all ? i : elements.ids[i];
    load_element(layout.bytes.data() + id * layout.stride, layout.type, layout.normalised, layout.components, values[i]);
  }
}

template <typename Value>
void GltfAccessors::replace_sparse(const Layout& layout, const ElementSelection& elements, std::vector<Value>& values) const {
  const JsonCursor sparse = layout.place["sparse"];
  if (!sparse.exists()) return;
  const std::uint64_t count = sparse["count"].whole();
  const auto range = [&](const JsonCursor& part, std::size_t element) {
    const std::uint32_t view = part["bufferView"].required_index(document_.array("bufferViews").size(), "buffer views");
    const std::span<const std::byte> bytes = document_.view(view);
    const std::uint64_t offset = part["byteOffset"].whole(0);
    if (!fits(count, element, element, offset, bytes.size())) part.fail("reaches past the end of its buffer view");
    return count == 0 ? bytes.first(0) : bytes.subspan(offset);
  };
  const ComponentType id_type = read_component_type(sparse["indices"]["componentType"]);
  if (!is_unsigned(id_type)) sparse["indices"]["componentType"].fail("must be an unsigned integer");
  const std::size_t element = size_of(layout.type) * layout.components;
  const std::span<const std::byte> ids = range(sparse["indices"], size_of(id_type));
  const std::span<const std::byte> replacements = range(sparse["values"], element);
  // No memory grows here, but time does when many primitives share the accessor.
  document_.charge(count * sizeof(std::uint32_t), sparse);
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t id = load_integer(ids.data() + i * size_of(id_type), id_type);
    if (id >= layout.count) sparse["indices"].fail("names element " + std::to_string(id) + " of " + std::to_string(layout.count));
    std::size_t target = id;
    if (!elements.all) {
      const auto found = std::lower_bound(elements.ids.begin(), elements.ids.end(), id);
      if (found == elements.ids.end() || *found != id) continue;
      target = static_cast<std::size_t>(found - elements.ids.begin());
    }
    load_element(replacements.data() + i * element, layout.type, layout.normalised, layout.components, values[target]);
  }
}

template <typename Value>
std::vector<Value> GltfAccessors::read(const JsonCursor& place, unsigned components, const ElementSelection& elements) const {
  const Layout layout = this->layout(place);
  if (layout.components != components) {
    layout.place["type"].fail("has " + std::to_string(layout.components) + " components where " + place.path() + " needs " +
                              std::to_string(components));
  }
  if (std::is_same_v<Value, std::uint32_t> || std::is_same_v<Value, glm::u32vec4>) {
    if (!is_unsigned(layout.type)) layout.place["componentType"].fail("must be an unsigned integer for " + place.path());
  }
  if (!elements.all && !elements.ids.empty() && elements.ids.back() >= layout.count) {
    layout.place.fail("has " + std::to_string(layout.count) + " elements; an index asks for number " + std::to_string(elements.ids.back()));
  }
  const std::uint64_t count = elements.all ? layout.count : elements.ids.size();
  // Without a buffer view the count is backed by no bytes, so that this is what bounds it; the division keeps the product in range.
  document_.charge(std::min<std::uint64_t>(count, UINT64_MAX / 2 / sizeof(Value)) * sizeof(Value), layout.place);
  std::vector<Value> values(count, zero<Value>());
  read_dense(layout, elements, values);
  replace_sparse(layout, elements, values);
  return values;
}

std::size_t GltfAccessors::count(const JsonCursor& place) const {
  return layout(place).count;
}

std::vector<std::uint32_t> GltfAccessors::integers(const JsonCursor& place) const {
  return read<std::uint32_t>(place, 1, {});
}

std::vector<float> GltfAccessors::scalars(const JsonCursor& place, const ElementSelection& elements) const {
  return read<float>(place, 1, elements);
}

std::vector<Vec2> GltfAccessors::vec2s(const JsonCursor& place, const ElementSelection& elements) const {
  return read<Vec2>(place, 2, elements);
}

std::vector<Vec3> GltfAccessors::vec3s(const JsonCursor& place, const ElementSelection& elements) const {
  return read<Vec3>(place, 3, elements);
}

std::vector<Vec4> GltfAccessors::vec4s(const JsonCursor& place, const ElementSelection& elements) const {
  return read<Vec4>(place, 4, elements);
}

std::vector<Mat4> GltfAccessors::mat4s(const JsonCursor& place) const {
  return read<Mat4>(place, 16, {});
}

std::vector<Vec4> GltfAccessors::colours(const JsonCursor& place, const ElementSelection& elements) const {
  if (layout(place).components == 4) return vec4s(place, elements);
  const std::vector<Vec3> rgb = vec3s(place, elements);
  std::vector<Vec4> colours(rgb.size());
  std::transform(rgb.begin(), rgb.end(), colours.begin(), [](const Vec3& colour) { return Vec4(colour, 1.0F); });
  return colours;
}

std::vector<glm::u32vec4> GltfAccessors::integer_vec4s(const JsonCursor& place, const ElementSelection& elements) const {
  return read<glm::u32vec4>(place, 4, elements);
}

}  // namespace grove

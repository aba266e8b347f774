#include "grove/scene/gltf/nodes.h"

#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "grove/base/error.h"

namespace grove {
namespace {

// World transforms are built in double: chains of a hundred nodes are common, and the result should be a float's best.
using DMat4 = glm::dmat4;

DMat4 local_matrix(const JsonCursor& node) {
  const std::vector<double> matrix = node["matrix"].numbers(16);
  if (!matrix.empty()) {
    DMat4 m;
    for (int i = 0; i < 16; ++i) m[i / 4][i % 4] = matrix[static_cast<std::size_t>(i)];
    // Only affine maps are allowed; whatever the file says here, the last row is 0 0 0 1.
    for (int column = 0; column < 4; ++column) m[column][3] = column == 3 ? 1.0 : 0.0;
    return m;
  }
  const auto vector = [&](const char* name, glm::dvec3 fallback) {
    const std::vector<double> v = node[name].numbers(3);
    return v.empty() ? fallback : glm::dvec3(v[0], v[1], v[2]);
  };
  const std::vector<double> q = node["rotation"].numbers(4);
  return compose_transform(vector("translation", glm::dvec3(0.0)),
                           q.empty() ? glm::dvec4(0.0, 0.0, 0.0, 1.0) : glm::dvec4(q[0], q[1], q[2], q[3]),
                           vector("scale", glm::dvec3(1.0)));
}

Mat4 to_single(const DMat4& matrix) {
  Mat4 m;
  for (int i = 0; i < 16; ++i) m[i / 4][i % 4] = to_float(matrix[i / 4][i % 4]);
  return m;
}

/// The children and parents that a file's nodes name, checked to be a forest where the walk goes.
class Walk {
 public:
  Walk(GltfDocument& document, Scene& scene)
      : document_(document), scene_(scene), nodes_(document.array("nodes")), reached_(nodes_.size(), false) {
    result_.to_world.assign(nodes_.size(), Mat4(std::numeric_limits<float>::quiet_NaN()));
  }

  GltfNodes run() {
    const std::vector<std::uint32_t> file_roots = find_file_roots();
    const JsonCursor scenes = document_.array("scenes");
    if (scenes.size() == 0) {
      for (const std::uint32_t root : file_roots) walk_from(root, true, nodes_);
      return std::move(result_);
    }
    const JsonCursor shown = scenes.element(document_.root()["scene"].index(scenes.size(), "scenes").value_or(0))["nodes"];
    for (std::size_t i = 0; i < shown.size(); ++i) {
      walk_from(shown.element(i).required_index(nodes_.size(), "nodes"), true, shown.element(i));
    }
    // Joints may hang from roots that the scene does not show.
    for (const std::uint32_t root : file_roots) {
      if (!reached_[root]) walk_from(root, false, nodes_);
    }
    return std::move(result_);
  }

 private:
  struct Entry {
    std::uint32_t node;
    DMat4 parent_to_world;
  };

  std::vector<std::uint32_t> find_file_roots() const {
    std::vector<bool> is_child(nodes_.size(), false);
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      const JsonCursor children = nodes_.element(i)["children"];
      for (std::size_t k = 0; k < children.size(); ++k) {
        is_child[children.element(k).required_index(nodes_.size(), "nodes")] = true;
      }
    }
    std::vector<std::uint32_t> roots;
    for (std::uint32_t i = 0; i < is_child.size(); ++i) {
      if (!is_child[i]) roots.push_back(i);
    }
    return roots;
  }

  void mark_reached(std::uint32_t node, const JsonCursor& place) {
    if (reached_[node])
      place.fail("names node " + std::to_string(node) + ", which can be reached twice: a cycle or a node with two parents");
    reached_[node] = true;
  }

  void walk_from(std::uint32_t root, bool shown, const JsonCursor& place) {
    mark_reached(root, place);
    std::vector<Entry> stack{{root, DMat4(1.0)}};
    while (!stack.empty()) {
      const Entry entry = stack.back();
      stack.pop_back();
      const JsonCursor node = nodes_.element(entry.node);
      const DMat4 to_world = entry.parent_to_world * local_matrix(node);
      record(entry.node, to_single(to_world), shown);
      const JsonCursor children = node["children"];
      // From the last, so that the first comes off the stack first.
      for (std::size_t k = children.size(); k-- > 0;) {
        const std::uint32_t child = children.element(k).required_index(nodes_.size(), "nodes");
        mark_reached(child, children.element(k));
        stack.push_back({child, to_world});
      }
    }
  }

  void record(std::uint32_t node, const Mat4& to_world, bool shown) {
    result_.to_world[node] = to_world;
    if (!shown) return;
    if (is_finite(to_world)) {
      result_.shown.push_back({node, to_world});
    } else if (document_.is_first("infinite node")) {
      scene_.warn("nodes with a transform that is not finite are left out, such as nodes[" + std::to_string(node) + "]");
    }
  }

  GltfDocument& document_;
  Scene& scene_;
  JsonCursor nodes_;
  std::vector<bool> reached_;
  GltfNodes result_;
};

}  // namespace

glm::dmat4 compose_transform(const glm::dvec3& translation, const glm::dvec4& rotation, const glm::dvec3& scale) {
  DMat4 m(1.0);
  // Exporters round, so that a quaternion is rarely of unit length exactly.
  const double length = glm::length(rotation);
  if (length > 0.0) {
    const auto [x, y, z, w] = std::array{rotation.x / length, rotation.y / length, rotation.z / length, rotation.w / length};
    m[0] = {1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + z * w), 2.0 * (x * z - y * w), 0.0};
    m[1] = {2.0 * (x * y - z * w), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z + x * w), 0.0};
    m[2] = {2.0 * (x * z + y * w), 2.0 * (y * z - x * w), 1.0 - 2.0 * (x * x + y * y), 0.0};
  }
  for (int axis = 0; axis < 3; ++axis) m[axis] *= scale[axis];
  m[3] = glm::dvec4(translation, 1.0);
  return m;
}

bool is_finite(const Mat4& matrix) {
  for (int i = 0; i < 16; ++i) {
    if (!std::isfinite(matrix[i / 4][i % 4])) return false;
  }
  return true;
}

GltfNodes read_nodes(GltfDocument& document, Scene& scene) {
  return Walk(document, scene).run();
}

}  // namespace grove

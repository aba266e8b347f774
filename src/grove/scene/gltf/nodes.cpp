#include "grove/scene/gltf/nodes.h"

#include <string>

#include "grove/base/error.h"
#include "grove/scene/animation/affine.h"

namespace grove {
namespace {

NodePose read_pose(const JsonCursor& node) {
  NodePose pose;
  const std::vector<double> matrix = node["matrix"].numbers(16);
  if (!matrix.empty()) {
    glm::dmat4& m = pose.matrix.emplace();
    for (int i = 0; i < 16; ++i) m[i / 4][i % 4] = matrix[static_cast<std::size_t>(i)];
    // Only affine maps are allowed; whatever the file says here, the last row is 0 0 0 1.
    for (int column = 0; column < 4; ++column) m[column][3] = column == 3 ? 1.0 : 0.0;
    return pose;
  }
  const auto read = [&](const char* name, glm::dvec3& vector) {
    const std::vector<double> v = node[name].numbers(3);
    if (!v.empty()) vector = {v[0], v[1], v[2]};
  };
  read("translation", pose.translation);
  read("scale", pose.scale);
  const std::vector<double> q = node["rotation"].numbers(4);
  if (!q.empty()) pose.rotation = {q[0], q[1], q[2], q[3]};
  return pose;
}

/// The children and parents that a file's nodes name, checked to be a forest where the walk goes.
class Walk {
 public:
  Walk(GltfDocument& document, Scene& scene)
      : document_(document), scene_(scene), nodes_(document.array("nodes")), reached_(nodes_.size(), false) {
    result_.tree.parent.assign(nodes_.size(), NodeTree::kNoParent);
    result_.tree.rest.resize(nodes_.size());
  }

  GltfNodes run() {
    walk();
    result_.to_world = result_.tree.world_transforms(result_.tree.rest);
    for (const std::uint32_t node : shown_) show(node);
    return std::move(result_);
  }

 private:
  void walk() {
    const std::vector<std::uint32_t> file_roots = find_file_roots();
    const JsonCursor scenes = document_.array("scenes");
    if (scenes.size() == 0) {
      for (const std::uint32_t root : file_roots) walk_from(root, true, nodes_);
      return;
    }
    const JsonCursor shown = scenes.element(document_.root()["scene"].index(scenes.size(), "scenes").value_or(0))["nodes"];
    for (std::size_t i = 0; i < shown.size(); ++i) {
      walk_from(shown.element(i).required_index(nodes_.size(), "nodes"), true, shown.element(i));
    }
    // Joints may hang from roots that the scene does not show.
    for (const std::uint32_t root : file_roots) {
      if (!reached_[root]) walk_from(root, false, nodes_);
    }
  }

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
    std::vector<std::uint32_t> stack{root};
    while (!stack.empty()) {
      const std::uint32_t id = stack.back();
      stack.pop_back();
      const JsonCursor node = nodes_.element(id);
      result_.tree.rest[id] = read_pose(node);
      result_.tree.order.push_back(id);
      if (shown) shown_.push_back(id);
      const JsonCursor children = node["children"];
      // From the last, so that the first comes off the stack first.
      for (std::size_t k = children.size(); k-- > 0;) {
        const std::uint32_t child = children.element(k).required_index(nodes_.size(), "nodes");
        mark_reached(child, children.element(k));
        result_.tree.parent[child] = id;
        stack.push_back(child);
      }
    }
  }

  void show(std::uint32_t node) {
    if (is_finite(result_.to_world[node])) {
      result_.shown.push_back({node, result_.to_world[node]});
    } else if (document_.is_first("infinite node")) {
      scene_.warn("nodes with a transform that is not finite are left out, such as nodes[" + std::to_string(node) + "]");
    }
  }

  GltfDocument& document_;
  Scene& scene_;
  JsonCursor nodes_;
  std::vector<bool> reached_;
  std::vector<std::uint32_t> shown_;
  GltfNodes result_;
};

}  // namespace

GltfNodes read_nodes(GltfDocument& document, Scene& scene) {
  return Walk(document, scene).run();
}

}  // namespace grove

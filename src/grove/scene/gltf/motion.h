#pragma once

#include <optional>
#include <vector>

#include "grove/scene/animation/scene_animation.h"
#include "grove/scene/gltf/nodes.h"

namespace grove {

/// What an animation moves, asked and added to while the parts of a scene are read.
class GltfMotion {
 public:
  /// Nothing moves.
  explicit GltfMotion(const GltfNodes& nodes);
  GltfMotion(const GltfNodes& nodes, SceneAnimation animation);

  /// Whether the node's place in the world changes.
  [[nodiscard]] bool moves(std::uint32_t node) const { return moves_[node]; }
  /// Whether its mesh's morph weights change.
  [[nodiscard]] bool morphs(std::uint32_t node) const { return morphs_[node]; }
  /// Whether one of its joints moves.
  [[nodiscard]] bool bends(const Skin& skin) const;

  // Each is called with what will have the number `number` in the scene's list, and does nothing where the node does not move.
  void follow_instance(std::uint32_t node, std::size_t number, const Mat4& in_node);
  void follow_camera(std::uint32_t node, std::size_t number);
  void follow_light(std::uint32_t node, std::size_t number);
  /// The object's vertices move, by this skin where there is one.
  void add_object(DeformingObject object, std::optional<Skin> skin);

  /// The animation with all that was added; nothing where there is none.
  [[nodiscard]] std::optional<SceneAnimation> finish() { return std::move(animation_); }

 private:
  void follow(std::vector<NodeFollower>& followers, std::uint32_t node, std::size_t number, const Mat4& in_node);

  std::optional<SceneAnimation> animation_;
  std::vector<bool> moves_;
  std::vector<bool> morphs_;
};

}  // namespace grove

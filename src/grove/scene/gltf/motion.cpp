#include "grove/scene/gltf/motion.h"

#include <algorithm>
#include <utility>

namespace grove {

GltfMotion::GltfMotion(const GltfNodes& nodes) : moves_(nodes.tree.size(), false), morphs_(nodes.tree.size(), false) {}

GltfMotion::GltfMotion(const GltfNodes& nodes, SceneAnimation animation) : GltfMotion(nodes) {
  std::vector<bool> has_pose(nodes.tree.size(), false);
  for (const AnimationChannel& channel : animation.channels) {
    (channel.target == ChannelTarget::weights ? morphs_ : has_pose)[channel.node] = true;
  }
  moves_ = nodes.tree.below(has_pose);
  animation.nodes = nodes.tree;
  animation_ = std::move(animation);
}

bool GltfMotion::bends(const Skin& skin) const {
  return std::ranges::any_of(skin.joints, [&](std::uint32_t joint) { return moves_[joint]; });
}

void GltfMotion::follow_instance(std::uint32_t node, std::size_t number, const Mat4& in_node) {
  if (animation_) follow(animation_->instances, node, number, in_node);
}

void GltfMotion::follow_camera(std::uint32_t node, std::size_t number) {
  if (animation_) follow(animation_->cameras, node, number, Mat4(1.0F));
}

void GltfMotion::follow_light(std::uint32_t node, std::size_t number) {
  if (animation_) follow(animation_->lights, node, number, Mat4(1.0F));
}

void GltfMotion::follow(std::vector<NodeFollower>& followers, std::uint32_t node, std::size_t number, const Mat4& in_node) {
  if (moves_[node]) followers.push_back({static_cast<std::uint32_t>(number), node, in_node});
}

void GltfMotion::add_object(DeformingObject object, std::optional<Skin> skin) {
  if (!animation_) return;
  if (skin) {
    object.skin = static_cast<std::uint32_t>(animation_->skins.size());
    animation_->skins.push_back(std::move(*skin));
  }
  animation_->objects.push_back(std::move(object));
}

}  // namespace grove

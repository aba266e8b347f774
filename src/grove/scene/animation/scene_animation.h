#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "grove/scene/animation/deform.h"
#include "grove/scene/animation/keyframes.h"
#include "grove/scene/animation/node_tree.h"

namespace grove {

enum class ChannelTarget : std::uint8_t { translation, rotation, scale, weights };

/// What moves one property of one node.
struct AnimationChannel {
  std::uint32_t node = 0;
  ChannelTarget target = ChannelTarget::translation;
  KeyframeTrack track;
};

/// The joints that bend a surface.
struct Skin {
  std::vector<std::uint32_t> joints;  ///< nodes
  std::vector<Mat4> inverse_bind;     ///< one a joint: from the bind pose to the joint's space
};

/// An instance, camera or light that stands where a node is.
struct NodeFollower {
  std::uint32_t number = 0;  ///< in the scene's list
  std::uint32_t node = 0;
  Mat4 in_node{1.0F};  ///< instances: from the object's space to the node's
};

/// An object of the scene whose vertices move.
struct DeformingObject {
  std::uint32_t object = 0;
  std::uint32_t node = 0;             ///< whose weights it takes
  std::optional<std::uint32_t> skin;  ///< with one its vertices are in world space
  std::vector<float> rest_weights;
  std::vector<DeformableSurface> parts;  ///< one for each part of the object
};

/// One animation of a file, with all that it takes to pose the scene: the node hierarchy, and what hangs on it that moves. What the animation does not
/// move is not here.
struct SceneAnimation {
  std::string name;
  double begin = 0.0;  ///< seconds, the first and the last keyframe
  double end = 0.0;
  NodeTree nodes;
  std::vector<AnimationChannel> channels;
  std::vector<Skin> skins;
  std::vector<NodeFollower> instances;
  std::vector<NodeFollower> cameras;
  std::vector<NodeFollower> lights;
  std::vector<DeformingObject> objects;
};

}  // namespace grove

#include "grove/scene/animation/animated_scene.h"

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

#include "grove/base/check.h"
#include "grove/math/to_float.h"
#include "grove/scene/animation/affine.h"
#include "grove/scene/animation/placement.h"

namespace grove {
namespace {

bool same_bits(const std::vector<float>& a, const std::vector<float>& b) {
  return std::ranges::equal(
      a, b, {}, [](float x) { return std::bit_cast<std::uint32_t>(x); }, [](float x) { return std::bit_cast<std::uint32_t>(x); });
}

bool same_bits(const std::vector<Mat4>& a, const std::vector<Mat4>& b) {
  return std::ranges::equal(a, b, [](const Mat4& x, const Mat4& y) { return grove::same_bits(x, y); });
}

void set_pose(NodePose& pose, ChannelTarget target, std::span<const double> value) {
  if (target == ChannelTarget::rotation) {
    pose.rotation = {value[0], value[1], value[2], value[3]};
    return;
  }
  (target == ChannelTarget::scale ? pose.scale : pose.translation) = {value[0], value[1], value[2]};
}

}  // namespace

AnimatedScene::AnimatedScene(Scene scene, SceneAnimation animation) : scene_(std::move(scene)), animation_(std::move(animation)) {
  poses_ = animation_->nodes.rest;
  deformations_.resize(animation_->objects.size());
  weights_.reserve(animation_->objects.size());
  for (const DeformingObject& object : animation_->objects) {
    GROVE_CHECK(object.parts.size() == scene_.objects[object.object].parts.size());
    weights_.push_back(object.rest_weights);
  }
}

AnimatedScene::AnimatedScene(std::function<Scene(double)> make, double begin, double end) : scene_(make(begin)), make_(std::move(make)) {
  animation_.emplace();
  animation_->begin = begin;
  animation_->end = end;
}

std::size_t AnimatedScene::deforming_object_count() const {
  if (make_) return scene_.objects.size();
  return animation_ ? animation_->objects.size() : 0;
}

SceneChanges AnimatedScene::move_to(double time) {
  SceneChanges changes;
  if (!animation_) return changes;
  pose(time);
  const std::vector<Mat4> to_world = animation_->nodes.world_transforms(poses_);
  move_instances(to_world, changes);
  move_cameras(to_world, changes);
  move_lights(to_world, changes);
  move_vertices(to_world, changes);
  if (make_) move_made(std::clamp(time, animation_->begin, animation_->end), changes);
  has_moved_ = true;
  return changes;
}

void AnimatedScene::pose(double time) {
  std::vector<double> value;
  for (const AnimationChannel& channel : animation_->channels) {
    value.resize(channel.track.width);
    channel.track.sample(time, value);
    if (channel.target != ChannelTarget::weights) {
      set_pose(poses_[channel.node], channel.target, value);
      continue;
    }
    for (std::size_t i = 0; i < weights_.size(); ++i) {
      if (animation_->objects[i].node != channel.node) continue;
      weights_[i].resize(value.size());
      std::ranges::transform(value, weights_[i].begin(), to_float);
    }
  }
}

void AnimatedScene::move_instances(const std::vector<Mat4>& to_world, SceneChanges& changes) {
  changes.instances.reserve(animation_->instances.size());
  for (const NodeFollower& follower : animation_->instances) {
    Instance& instance = scene_.instances[follower.number];
    const Mat4 matrix = to_world[follower.node] * follower.in_node;
    if (has_moved_ && same_bits(matrix, instance.object_to_world.matrix())) continue;
    instance.object_to_world = Transform(matrix);
    changes.instances.push_back(follower.number);
  }
}

void AnimatedScene::move_cameras(const std::vector<Mat4>& to_world, SceneChanges& changes) {
  for (const NodeFollower& follower : animation_->cameras) {
    Camera& camera = scene_.cameras[follower.number];
    const Mat4 before = camera.camera_to_world;
    place_camera(to_world[follower.node], camera);
    changes.cameras = changes.cameras || !has_moved_ || !same_bits(before, camera.camera_to_world);
  }
}

void AnimatedScene::move_lights(const std::vector<Mat4>& to_world, SceneChanges& changes) {
  for (const NodeFollower& follower : animation_->lights) {
    PunctualLight& light = scene_.lights[follower.number];
    const PunctualLight before = light;
    place_light(to_world[follower.node], light);
    changes.lights = changes.lights || !has_moved_ || before.position != light.position || before.direction != light.direction;
  }
}

void AnimatedScene::move_vertices(const std::vector<Mat4>& to_world, SceneChanges& changes) {
  changes.objects.reserve(animation_->objects.size());
  for (std::size_t i = 0; i < animation_->objects.size(); ++i) {
    const DeformingObject& deforming = animation_->objects[i];
    std::vector<Mat4> joints;
    if (deforming.skin) joints = joint_transforms(animation_->skins[*deforming.skin], to_world);
    Deformation& last = deformations_[i];
    if (last.is_known && same_bits(weights_[i], last.weights) && same_bits(joints, last.joints)) continue;
    last = {true, weights_[i], std::move(joints)};

    Object& object = scene_.objects[deforming.object];
    TriangleMesh& mesh = *std::get<std::shared_ptr<TriangleMesh>>(object.geometry);
    positions_.resize(mesh.vertices().size());
    for (std::uint32_t p = 0; p < deforming.parts.size(); ++p) {
      const DeformableSurface& surface = deforming.parts[p];
      Part& part = object.parts[p];
      deform(surface, last.weights, last.joints,
             {std::span(positions_).subspan(mesh.first_vertex(p), surface.vertices.size()), part.normals, part.tangents});
    }
    mesh.move_vertices(positions_);
    changes.objects.push_back(deforming.object);
  }
}

void AnimatedScene::move_made(double time, SceneChanges& changes) {
  Scene made = make_(time);
  GROVE_CHECK(made.objects.size() == scene_.objects.size());
  changes.objects.reserve(made.objects.size());
  for (std::uint32_t i = 0; i < made.objects.size(); ++i) {
    const auto* const from = std::get_if<std::shared_ptr<TriangleMesh>>(&made.objects[i].geometry);
    const auto* const to = std::get_if<std::shared_ptr<TriangleMesh>>(&scene_.objects[i].geometry);
    if (from == nullptr || to == nullptr) continue;
    if (has_moved_ && std::ranges::equal((*from)->vertices(), (*to)->vertices())) continue;
    (*to)->move_vertices((*from)->vertices());
    for (std::size_t p = 0; p < made.objects[i].parts.size(); ++p) {
      scene_.objects[i].parts[p].normals = std::move(made.objects[i].parts[p].normals);
    }
    changes.objects.push_back(i);
  }
}

std::vector<Mat4> joint_transforms(const Skin& skin, const std::vector<Mat4>& to_world) {
  std::vector<Mat4> transforms(skin.joints.size());
  for (std::size_t i = 0; i < transforms.size(); ++i) {
    transforms[i] = to_world[skin.joints[i]] * skin.inverse_bind[i];
    if (!is_finite(transforms[i])) transforms[i] = Mat4(1.0F);
  }
  return transforms;
}

}  // namespace grove

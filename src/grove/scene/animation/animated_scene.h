#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "grove/scene/animation/scene_animation.h"
#include "grove/scene/animation/scene_changes.h"
#include "grove/scene/scene.h"

namespace grove {

/// A scene that can be put to any time of one of its animations. What the animation moves rigidly stands on instances, and what it bends or morphs is an
/// object of its own, so that `move_to` and the structures that follow (SceneAccelerator::update) touch nothing else. A scene without animations is the
/// same at all times. Not for several threads at once.
class AnimatedScene {
 public:
  /// An empty scene.
  AnimatedScene() = default;
  /// A scene that does not move.
  explicit AnimatedScene(Scene scene) : scene_(std::move(scene)) {}
  /// `animation` must be of this scene.
  AnimatedScene(Scene scene, SceneAnimation animation);

  /// A scene that is made anew for each time from `begin` to `end`: the same objects and instances at all times but for where vertices are, and their normals.
  AnimatedScene(std::function<Scene(double time)> make, double begin, double end);

  /// The scene as it was last put; before that as the file has it at rest.
  [[nodiscard]] const Scene& scene() const { return scene_; }
  [[nodiscard]] Scene& scene() { return scene_; }
  /// Nothing for a scene that does not move.
  [[nodiscard]] const std::optional<SceneAnimation>& animation() const { return animation_; }
  /// Objects whose vertices move at some time.
  [[nodiscard]] std::size_t deforming_object_count() const;

  /// Puts the scene to a time, in seconds of the file, and tells what has changed since the last call; at the first call all that can. Before the first keyframe
  /// and after the last things stay as they are there. A camera or light whose node has no direction at that time stays where it was. Vertices are moved
  /// in parallel in the caller's oneTBB arena, bit for bit the same for any number of threads, and whichever times came before.
  SceneChanges move_to(double time);

 private:
  // What an object was last deformed by.
  struct Deformation {
    bool is_known = false;
    std::vector<float> weights;
    std::vector<Mat4> joints;
  };

  void pose(double time);
  void move_instances(const std::vector<Mat4>& to_world, SceneChanges& changes);
  void move_cameras(const std::vector<Mat4>& to_world, SceneChanges& changes);
  void move_lights(const std::vector<Mat4>& to_world, SceneChanges& changes);
  void move_vertices(const std::vector<Mat4>& to_world, SceneChanges& changes);
  void move_made(double time, SceneChanges& changes);

  Scene scene_;
  std::optional<SceneAnimation> animation_;
  std::function<Scene(double)> make_;
  bool has_moved_ = false;
  std::vector<NodePose> poses_;
  std::vector<std::vector<float>> weights_;  // by object of the animation
  std::vector<Deformation> deformations_;    // by object of the animation
  std::vector<Vec3> positions_;              // room to deform in
};

/// From the bind pose to world space for each joint, where `to_world` has the nodes. A joint without a finite place holds its vertices where the bind pose
/// has them.
[[nodiscard]] std::vector<Mat4> joint_transforms(const Skin& skin, const std::vector<Mat4>& to_world);

}  // namespace grove

#pragma once

#include "grove/scene/camera.h"
#include "grove/scene/light.h"

namespace grove {

/// Puts a camera where its node is; scale has no part in it. Returns false and leaves the camera when the node's axes do not span the space.
bool place_camera(const Mat4& node_to_world, Camera& camera);

/// Puts a light where its node is, shining along the node's -z. Returns false and leaves the light when its place is not finite, or it needs a direction and
/// the node is scaled to nothing.
bool place_light(const Mat4& node_to_world, PunctualLight& light);

}  // namespace grove

#pragma once

// GLM_FORCE_XYZW_ONLY keeps the vectors plain (no swizzle members) and quick to compile.
#ifndef GLM_FORCE_XYZW_ONLY
#define GLM_FORCE_XYZW_ONLY
#endif
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace grove {

using Vec2 = glm::vec2;
using Vec3 = glm::vec3;
using Vec4 = glm::vec4;
using Mat3 = glm::mat3;
/// Column-major, acting on column vectors, as in glTF.
using Mat4 = glm::mat4;
/// The three vertex indices of a triangle.
using Triangle = glm::u32vec3;

inline constexpr float kPi = 3.14159265358979323846F;

}  // namespace grove

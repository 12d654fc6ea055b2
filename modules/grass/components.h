// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "engine/ecs/entity.h"
#include "engine/math/bounds.h"
#include "engine/math/types.h"

namespace gloam {

/// Grass grows on the upward-facing triangles of the entity's mesh. Blades are in metres; SceneUnits says how many of
/// them a unit of the mesh is.
struct GrassSurface {
  float density = 0.0f;  ///< blades/m²
  std::uint32_t seed = 1;
  vec2 height_m = vec2(0.3f, 0.06f);  ///< mean, deviation
  float width_m = 0.006f;
  float damping = 1.5f;              ///< of the blades' swings, 1/s: they fall to 1/e in 1 s over damping
  float max_distance_m = 40.0f;      ///< quantisation range of the LOD
  std::uint32_t types = 0;           ///< blade file in SceneStrings; 0: the built-in five types
  std::uint32_t texture = 0;         ///< image of the blades in SceneStrings; 0: procedural colours
  std::uint32_t texture_layers = 0;  ///< layers side by side in the image, at most 16; 0: blade_layers() decides
};

enum class ColliderShape : std::uint8_t { none, sphere, capsule, box };

/// An obstacle that moves grass; follows the node's animation. A capsule's height includes its caps and starts at the
/// node's origin, along +Y. Sizes are in units of the node, like those of meshes.
struct Collider {
  ColliderShape shape = ColliderShape::none;
  float radius_m = 0.5f;
  float height_m = 1.8f;
  vec3 size_m = vec3(1.0f);
};

/// Wind; at most one per scene. Its gusts are a field that begins at the node of the wind.
struct Wind {
  vec3 velocity = vec3(0.0f);  ///< m/s
  float gust = 0.3f;           ///< 0…1
};

/// One blade. Growth makes blades; a host may change or destroy them and then calls mark_changed or destroys the
/// entity. Positions are relative to the blade's patch (GrassPatch::origin) and along its axes.
struct GrassBlade {
  vec3 root_m = vec3(0.0f);
  vec3 ground_normal = vec3(0.0f, 1.0f, 0.0f);  ///< unit; no knot goes below the plane through the root
  float yaw = 0.0f;  ///< radians, around the ground normal: direction in which the stem leans
  float length_m = 0.3f;
  float width_m = 0.006f;  ///< at the root
  float rank = 0.0f;  ///< 0…1; where the LOD thins the field, blades of a high rank go first; a slave has its master's
  std::uint32_t slot = 0;    ///< 256 · index of the patch + index in the patch; its place in GPU buffers
  std::uint32_t master = 0;  ///< slot of the blade whose knots it copies, in the same patch; a master's own slot
  std::uint16_t type = 0;    ///< of the patch's blade types, < 16
  std::uint16_t layer = 0;   ///< texture layer, < 16; modulo the layers of the surface's image
};

/// Tags that keep masters and slaves in archetypes of their own.
struct GrassMasterTag {};
struct GrassSlaveTag {};

/// Up to 256 blades that are culled together. The entity has no mesh. Lengths are metres, also the origin: it is a
/// position in units times SceneUnits::metres_per_unit.
struct GrassPatch {
  Entity surface = kNoEntity;  ///< entity with the GrassSurface
  dvec3 origin = dvec3(0.0);   ///< world position of the middle of `roots`, metres
  dquat turn =
      dquat(1.0, 0.0, 0.0, 0.0);  ///< from the patch's axes to the world's: the ground has turned since it grew
  Aabb roots;                     ///< of the blades' roots, relative to the origin, along the patch's axes
  float reach_m = 0.0f;           ///< length of the longest blade
  float max_distance_m = 40.0f;
  std::uint32_t index = 0;  ///< among the field's patches
  std::uint32_t blades = 0;
  std::uint32_t masters = 0;  ///< they have the patch's first slots
};

}  // namespace gloam

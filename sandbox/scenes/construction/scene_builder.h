// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "engine/ecs/world.h"
#include "engine/scene/assets.h"
#include "engine/scene/components.h"
#include "engine/scene/gltf/import.h"
#include "modules/lights/components.h"

namespace gloam {

/// Pose of an animated node relative to its parent.
struct PoseKey {
  double time_s = 0.0;
  dvec3 translation = dvec3(0.0);
  dquat rotation = dquat(1.0, 0.0, 0.0, 0.0);
};

/// Fills a world by code, as the importer does from a file. The world must have all components registered and the
/// resources of prepare_scene_world.
class SceneBuilder {
 public:
  SceneBuilder(World& world, SceneInfo& info) : world_(world), info_(info) {}

  [[nodiscard]] std::uint32_t add_material(const Material& material);
  /// A material of one colour (linear RGB).
  [[nodiscard]] std::uint32_t add_plain(const std::string& name, vec3 color, float roughness, float metallic = 0.0f);
  /// A nearly black material that shines with this luminance, cd/m².
  [[nodiscard]] std::uint32_t add_glow(const std::string& name, vec3 luminance);
  [[nodiscard]] std::uint32_t add_mesh(const std::string& name, Primitive shape, std::uint32_t material);

  /// heading: radians about +Y.
  Entity add_instance(const std::string& name, std::uint32_t mesh, dvec3 position, double heading = 0.0,
                      dvec3 scale = dvec3(1.0));
  /// Adds a root node without a mesh, which other nodes may name as their Parent.
  Entity add_group(const std::string& name, dvec3 position, double heading = 0.0);
  Entity add_camera(const std::string& name, dvec3 eye, dvec3 target, float fov_y);
  /// direction: where the light shines, any length above 0. It has no effect on a point light.
  Entity add_light(const std::string& name, const Light& light, dvec3 position, dvec3 direction, bool casts_shadows);
  /// Adds a clip that moves a node of this builder; it loops with the time of its last key. keys: the first at time 0,
  /// times strictly increasing. Poses between keys are interpolated linearly.
  void add_clip(const std::string& name, Entity node, std::span<const PoseKey> keys);

 private:
  Entity add_node(const char* kind, const std::string& name, const LocalTransform& local);

  World& world_;
  SceneInfo& info_;
};

/// A rotation that turns −Z towards `direction` (length above 0) and keeps +Y as close to up as possible.
[[nodiscard]] dquat rotation_towards(dvec3 direction);

}  // namespace gloam

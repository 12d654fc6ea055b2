// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "engine/ecs/world.h"
#include "engine/math/types.h"
#include "modules/lights/components.h"
#include "sandbox/session/loading/light_patch.h"

namespace gloam {

/// What a panel can change of a light. Pose: of the light's node, relative to its parent.
struct LightValues {
  float intensity = 0.0f;  ///< candela; directional: lux
  vec3 color = vec3(1.0f);
  float range_m = 0.0f;
  float width_m = 0.0f;
  bool shadows = true;
  bool cookie = true;  ///< shows its image, if it has one
  bool muted = false;
  bool solo = false;
  dvec3 translation = dvec3(0.0);
  dquat rotation = dquat(1.0, 0.0, 0.0, 0.0);
  bool operator==(const LightValues&) const = default;
};

/// A light that a panel shows.
struct ControlledLight {
  Entity entity = kNoEntity;
  std::string name;
  LightKind kind = LightKind::point;
  std::uint32_t cookie = 0;  ///< Light::cookie of the scene
  bool movable = false;      ///< its node has a LocalTransform and no LocalMatrix
  LightValues values;
  LightValues scene_values;  ///< those that the scene has given it
};

/// Turns lights of a world off and on again, and changes and moves them. A light shines if it is not muted and, while
/// any light is solo, is solo itself.
class LightControls {
 public:
  /// All lights of the world, by name. The world must outlive it; lights that are gone later are left out.
  explicit LightControls(World& world);

  [[nodiscard]] std::span<const ControlledLight> lights() const { return lights_; }
  void set(std::size_t light, const LightValues& values);

  /// The world position of a light and the direction in which it shines, of its last pose.
  [[nodiscard]] dvec3 position(std::size_t light) const;
  [[nodiscard]] dvec3 direction(std::size_t light) const;
  /// Moves a light to a world position, or turns it to shine in a world direction (not 0). Nothing if it is not
  /// movable.
  void move(std::size_t light, const dvec3& position);
  void aim(std::size_t light, const dvec3& direction);

  /// The differences to the scene, for --lights. Lights without a name are left out.
  [[nodiscard]] LightPatch patch() const;

 private:
  void apply(const ControlledLight& light, bool any_solo);
  [[nodiscard]] dmat4 world_from_parent(const ControlledLight& light) const;

  World& world_;
  std::vector<ControlledLight> lights_;
};

}  // namespace gloam

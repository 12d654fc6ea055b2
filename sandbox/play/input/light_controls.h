// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "engine/ecs/world.h"
#include "modules/lights/components.h"

namespace gloam {

/// A light that a panel shows.
struct ControlledLight {
  Entity entity = kNoEntity;
  std::string name;
  LightKind kind = LightKind::point;
  float intensity = 0.0f;  ///< candela; directional: lux
  bool muted = false;
  bool solo = false;
};

/// Turns lights of a world off and on again, and changes their intensity. A light shines if it is not muted and, while
/// any light is solo, is solo itself.
class LightControls {
 public:
  /// All lights of the world, by name. The world must outlive it; lights that are gone later are left out.
  explicit LightControls(World& world);

  [[nodiscard]] std::span<const ControlledLight> lights() const { return lights_; }
  void set_intensity(std::size_t light, float intensity);
  void mute(std::size_t light, bool muted);
  void solo(std::size_t light, bool solo);

 private:
  void apply();

  World& world_;
  std::vector<ControlledLight> lights_;
};

}  // namespace gloam

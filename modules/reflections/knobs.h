// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "engine/render/knobs/knobs.h"
#include "modules/reflections/culling/tiles.h"

namespace gloam {

/// Current values of the module's knobs.
struct ReflectionKnobs {
  enum class Mode : std::uint8_t { tiers, planar, off };
  Mode mode = Mode::tiers;
  bool screen_space = true;  ///< tier 1
  bool proxies = true;       ///< tier 2
  bool temporal = false;
  bool pixel_roughness = true;
  bool blur = true;
  bool light_scale = true;
  float k1 = 0.0f;
  float k2 = 0.0f;
  float reach_m = 0.0f;
  std::uint32_t refine = 0;
  bool full_resolution = false;
  bool hierarchical = false;
  ProxyTileSettings tiles;
  std::uint32_t layers = 4;
  bool sphere_test = true;
  bool naive = false;

  /// Whether reflection images are drawn, for either of the first two tiers.
  [[nodiscard]] bool mirror() const { return screen_space || proxies; }
  [[nodiscard]] std::uint32_t scale() const { return full_resolution ? 1 : 2; }
};

void add_reflection_knobs(KnobRegistry& registry);
[[nodiscard]] ReflectionKnobs reflection_knobs(const KnobRegistry& registry);

}  // namespace gloam

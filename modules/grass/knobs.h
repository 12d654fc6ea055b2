// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "engine/render/knobs/knobs.h"

namespace gloam {

/// Threads of the simulation: one a knot, in workgroups of 32, 64 or 128; one a blade; or as suits the device.
enum class SimulationThreads : std::uint8_t { device, knots_32, knots_64, knots_128, blade };

/// Values of the module's knobs.
struct GrassKnobs {
  std::uint32_t slaves_per_master = 4;  ///< 0: every blade is simulated
  std::uint32_t iterations = 3;         ///< of constraints in each step
  double density_scale = 1.0;           ///< factor of GrassSurface::density
  float lod_pixels = 1.0f;              ///< least width of a blade's root, pixels; 0: no thinning
  std::uint32_t threshold = 254;        ///< greatest key that is drawn
  float cast_distance_m = 6.0f;         ///< blades nearer than this cast shadows
  SimulationThreads threads = SimulationThreads::device;
  bool readback = false;      ///< the CPU sizes the simulation's dispatch by an earlier frame's count
  bool all_segments = false;  ///< every blade has 15 segments, however small it is in the picture
};

void add_grass_knobs(KnobRegistry& registry);
[[nodiscard]] GrassKnobs grass_knobs(const KnobRegistry& registry);

}  // namespace gloam

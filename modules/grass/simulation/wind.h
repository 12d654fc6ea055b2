// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "engine/math/types.h"
#include "modules/grass/components.h"
#include "shaders/grass/grass_shared.h"

namespace gloam {

/// Greatest speed of the wind; a higher one is reduced to it.
inline constexpr double kGreatestWind = 1000.0;  // m/s

/// The wind over the whole field at one moment. All values are finite.
struct WindField {
  dvec3 velocity = dvec3(0.0);  ///< m/s
  double gust = 0.0;            ///< 0…1
  dvec3 drift = dvec3(0.0);     ///< way of the gusts, metres, 0…GLOAM_GRASS_WIND_PERIOD
};

/// wind: may be null (still air). NaN counts as 0. The drift follows from the step number alone, so a wind that changes
/// its velocity moves all gusts at once.
[[nodiscard]] WindField wind_at_step(const Wind* wind, std::uint32_t step, double step_s);

/// Velocity of the air; CPU twin of wind_velocity() in shaders/grass/simulation/wind_api.glsl. at: position in the
/// wind's field; it repeats after GLOAM_GRASS_WIND_PERIOD in x and z.
[[nodiscard]] dvec3 wind_velocity(const WindField& wind, dvec3 at);

/// A position in the wind's field, 0…GLOAM_GRASS_WIND_PERIOD, of a world position; NaN becomes 0.
[[nodiscard]] dvec3 wind_position(dvec3 world);

[[nodiscard]] shaders::GrassWind to_shader(const WindField& wind);
[[nodiscard]] WindField from_shader(const shaders::GrassWind& wind);

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/assets.h"

namespace gloam {

/// Images of builtin:dusk, computed.

/// Side of the square of paving that setts_images() show, metres.
inline constexpr float kSettsSide_m = 2.4f;

/// Rows of rounded setts, which repeat in both directions.
struct SettsImages {
  Image color;      ///< sRGB
  Image normal;     ///< tangent space; red along u, green along −v
  Image roughness;  ///< green: roughness, blue: metalness
};
[[nodiscard]] SettsImages setts_images();

/// The sky after sunset all around, with clouds and, on the horizon, a far town. u: the azimuth from −Z over +X, 0…1.
/// v: 0 at the zenith, 1 at kSkyLowest below the horizon; see sky_elevation(). sRGB, white is kBrightestSky.
[[nodiscard]] Image dusk_sky_image();
inline constexpr float kBrightestSky = 1.5f;  ///< cd/m²

/// The angle above the horizon that v shows, radians. Its rows are denser at the horizon.
[[nodiscard]] float sky_elevation(float v);

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string_view>

#include "engine/ecs/world.h"
#include "engine/scene/resources.h"

namespace gloam {

/// The greatest half float that is not infinite.
inline constexpr double kMostHalf = 65504.0;

/// Whether frames have the exposure that SceneEnvironment states. Otherwise it is metered, and not known before.
[[nodiscard]] bool has_stated_exposure(const World& world);

/// Factor from cd/m² and lux to the light in a view's half-float images (RenderView::light_scale): a power of two, so
/// that scaled light has the same bits of mantissa. It is 1 if white, 1.2 · 2^EV cd/m², is from 1/4 to 256. Otherwise
/// it brings white to the nearer end of that range: light of 255 times white does not overflow, and the darkest step of
/// a picture is a normal number.
[[nodiscard]] float light_scale(const SceneEnvironment& environment);

/// How bright a world is, as its components say without a picture. For factors of half floats: right to a few powers
/// of two, and more than that for lamps.
struct SceneBrightness {
  double lit = 0.0;      ///< cd/m²: the sky, and white surfaces in the light of the strongest light
  double emitted = 0.0;  ///< cd/m²: the greatest emission
};

/// Functions of modules that bring light into a world: the greatest luminance of a white surface, cd/m², that one of
/// their lights gives. Must be cheap. A resource of the world, by the module's name.
struct BrightnessSources {
  std::map<std::string_view, double (*)(const World&)> lit;
};

/// Sky, BrightnessSources, and the emissive factors of all materials.
[[nodiscard]] SceneBrightness scene_brightness(const World& world);

/// light_scale() without an exposure, for automatic exposure and captures. It is 1 if surfaces and emission are below
/// 49152 cd/m², so that a third of them may be added before light is clamped. Otherwise it brings them to 256…4096.
/// Emission 65536 times as bright as lit surfaces (but at least 65536 cd/m²) counts as no brighter, so that these keep
/// their precision. before: the scale of the view's last frame, or 1. It stays while light fits it, so that a
/// flickering lamp does not restart temporal accumulation in each frame.
[[nodiscard]] float light_scale(const SceneBrightness& brightness, float before = 1.0f);

}  // namespace gloam

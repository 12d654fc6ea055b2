// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "engine/math/types.h"

namespace gloam {

/// How a light casts shadows. A light without this component casts them with these defaults.
struct ShadowCaster {
  bool enabled = true;
  std::uint32_t resolution = 0;  ///< texels of a face's side; 0: chosen from screen coverage
};

/// World-space box of casters without a mesh (CasterSource), on any entity. Cascades of directional lights hold the
/// boxes of all meshes and all volumes; casters outside of them are drawn onto the near side of the light's box. Set it
/// before the systems of the view stage run. Ignored if a bound is not finite or min is above max.
struct CasterVolume {
  dvec3 min = dvec3(0.0);
  dvec3 max = dvec3(0.0);
};

/// The grid of texels of directional lights' maps; a world resource. Texels lie at multiples of their size from the
/// anchor, and sizes of maps are rounded in steps that follow from powers of two of the unit.
/// Shadows of casters about as thin as a texel depend on where texels begin. A module with such casters sets a point
/// that belongs to its scene, so that the same scene at another place has the same shadows. The point must rest: the
/// shadows shimmer in the frame in which it moves. Set it before the systems of the view stage run. The unit is a metre
/// (SceneUnits), so that the same scene in other units has the same shadows.
struct ShadowTexelGrid {
  dvec3 anchor = dvec3(0.0);
  double unit = 1.0;  ///< > 0; set by the module
};

/// Least radius of a lamp's ball for is_bulb(), as a share of the lamp's range.
inline constexpr double kLeastBulb = 1.0 / 200.0;

/// Whether an emissive mesh is part of a lamp: the glass or the flame that shines, not something in its way. A bulb
/// does not cast into the maps of its light. It touches the emitter's ball, or almost, and is not much larger. min,
/// max: bounds of the mesh, in the space of `light`. half_diagonal_m: half the diagonal of the mesh's own box; 0 for a
/// mesh that is not emissive. bulb_radius_m: radius of the emitter,
/// at least kLeastBulb of its range; below 0: the light is no lamp.
[[nodiscard]] bool is_bulb(const dvec3& light, double bulb_radius_m, const dvec3& min, const dvec3& max,
                           double half_diagonal_m);

}  // namespace gloam

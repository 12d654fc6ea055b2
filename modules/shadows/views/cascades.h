// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "engine/render/view.h"
#include "modules/shadows/outputs.h"
#include "modules/shadows/views/faces.h"

namespace gloam {

/// Box around everything in the world that may cast a shadow; a view resource, made by system shadow_bounds.
struct CasterBounds {
  dvec3 min = dvec3(std::numeric_limits<double>::infinity());
  dvec3 max = dvec3(-std::numeric_limits<double>::infinity());

  /// False without casters, and when one may be anywhere.
  [[nodiscard]] bool known() const;
  void grow(const dvec3& box_min, const dvec3& box_max) {
    min = glm::min(min, box_min);
    max = glm::max(max, box_max);
  }
};

/// What one cascade encloses. Neither its radius nor, for the casters' own sphere, its centre depends on where the
/// camera stands or looks.
struct CascadeSphere {
  std::uint32_t slice = 0;  ///< of the frustum, from the camera outwards
  dvec3 center = dvec3(0.0);
  double radius_m = 0.0;
};

/// Metres from the camera beyond which directional lights cast no shadow where nothing is known of casters.
inline constexpr double kDefaultShadowDistance = 100.0;
/// The same from where the casters begin, whatever is known. Sharing texels out farther would leave none for what is
/// near.
inline constexpr double kMostShadowDistance = 1000.0;

/// How far shadows of directional lights reach: a power of two times the diameter of the casters' bounds that encloses
/// them from where the camera is, at most kMostShadowDistance or, away from the casters, a power of two times that. It
/// is the same for all places among the casters.
[[nodiscard]] double shadow_distance(const RenderView& view, const CasterBounds& casters);

/// View depths at which slice 0…count − 1 of [near_m, far_m] end: the practical split scheme (Zhang et al. 2006),
/// mostly logarithmic for a perspective camera, uniform for an orthographic one.
[[nodiscard]] std::vector<double> cascade_splits(double near_m, double far_m, std::uint32_t count, bool orthographic);

/// The smallest sphere with its centre on the frustum's middle line round its part between two view depths.
[[nodiscard]] CascadeSphere slice_sphere(const RenderView& view, double near_m, double far_m);

/// Spheres of at most `count` cascades, inner ones first. A slice that reaches no caster has none; the first one that
/// would be larger than the casters' bounds becomes their sphere and is the last.
[[nodiscard]] std::vector<CascadeSphere> cascade_spheres(const RenderView& view, const CasterBounds& casters,
                                                         std::uint32_t count);

/// The box of a cascade: `square` says how many texels it has. Its corners lie on whole texels of a grid fixed to the
/// world, and its depths begin and end at steps of one, so that the map of a camera that moves shifts by whole texels.
/// It reaches from the first caster on the light's side to the last one; 1000 m to both sides of the sphere when they
/// are not known, and never more than 20 km.
[[nodiscard]] ShadowFace cascade_face(Entity light, const FaceAxes& axes, const CascadeSphere& sphere,
                                      const CasterBounds& casters, const AtlasSquare& square, float kernel_rim);

/// What shaders read, for positions relative to view_position.
[[nodiscard]] shaders::ShadowCascade cascade_constants(const ShadowFace& face, const dvec3& view_position,
                                                       float kernel_rim);

}  // namespace gloam

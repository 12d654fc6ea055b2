// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "engine/render/view.h"
#include "modules/shadows/outputs.h"
#include "modules/shadows/views/faces.h"

namespace gloam {

/// Box along any three axes: all points center + x · half_axes[0] + y · half_axes[1] + z · half_axes[2] with x, y and z
/// in −1 … 1.
struct OrientedBox {
  dvec3 center = dvec3(0.0);
  glm::dmat3 half_axes = glm::dmat3(0.0);
  [[nodiscard]] double half_diagonal() const;
};

/// World-space box around all casters; a view resource, written by system shadow_bounds.
struct CasterBounds {
  dvec3 min = dvec3(std::numeric_limits<double>::infinity());
  dvec3 max = dvec3(-std::numeric_limits<double>::infinity());
  dvec3 grid_anchor = dvec3(0.0);  ///< ShadowTexelGrid::anchor
  double grid_unit = 1.0;          ///< ShadowTexelGrid::unit

  static constexpr int kLeastExponent = -64;
  /// Numbers of casters by size: whose half diagonal is in (2^(e − 1), 2^e] grid units, where e − kLeastExponent is the
  /// index.
  std::array<std::uint32_t, 128> sizes{};
  double log2_sizes = 0.0;  ///< sum of the binary logarithms of the casters' half diagonals, grid units

  /// The largest casters, largest first. A slanted ground is as deep as it is wide in a box along the world's axes, but
  /// flat in its own. All other casters are in the box from rest_min to rest_max.
  static constexpr std::size_t kLargest = 8;
  std::array<OrientedBox, kLargest> largest{};
  std::size_t largest_count = 0;
  dvec3 rest_min = dvec3(std::numeric_limits<double>::infinity());
  dvec3 rest_max = dvec3(-std::numeric_limits<double>::infinity());

  /// False when there are no casters, and when a bound is not finite.
  [[nodiscard]] bool known() const;
  /// Geometric mean of the casters' half diagonals, rounded up to a power of two grid units, but at most eight times
  /// their lower median, so that a ground of any width does not raise it further; 0: unknown.
  [[nodiscard]] double usual_size() const;
  void add_size(double half_diagonal);
  void add_sizes(const CasterBounds& other);
  void grow(const dvec3& box_min, const dvec3& box_max) {
    min = glm::min(min, box_min);
    max = glm::max(max, box_max);
    rest_min = glm::min(rest_min, box_min);
    rest_max = glm::max(rest_max, box_max);
  }
  void grow(const OrientedBox& box);
  /// Adds other's boxes; not its sizes.
  void grow(const CasterBounds& other);

 private:
  void add_large(const OrientedBox& box);
};

/// The bounding sphere of one cascade. Its radius does not depend on the camera's position or direction. If it is the
/// sphere around all casters, its centre does not depend on them either.
struct CascadeSphere {
  std::uint32_t slice = 0;  ///< slice of the frustum, counted from the camera outwards
  dvec3 center = dvec3(0.0);
  double radius_m = 0.0;
};

/// Distance from the camera to which shadows of directional lights reach when the casters' bounds are unknown, in
/// distances of the near plane.
inline constexpr double kDefaultShadowDistance = 1000.0;
/// Greatest shadow_distance() for a camera inside the casters' bounds: the greater of so many distances of the near
/// plane and so many usual sizes of casters. A greater distance would leave too few texels for near surfaces.
inline constexpr double kMostNearPlanes = 10000.0;
inline constexpr double kMostCasterSizes = 64.0;

/// Distance from the camera to which shadows of directional lights reach. It is the diameter of the casters' bounding
/// sphere, times the smallest power of two (at least 1) with which all casters are within that distance of the
/// camera. The limit is as above for a camera inside the sphere; outside, a power of two that grows with the
/// distance to the sphere multiplies the limit. All positions inside the sphere get the same result.
[[nodiscard]] double shadow_distance(const RenderView& view, const CasterBounds& casters);

/// The view depths at which slices 0 … count − 1 of [near_m, far_m] end, ascending; the last is far_m. The practical
/// split scheme (Zhang et al. 2006): mostly logarithmic for a perspective camera, uniform for an orthographic one.
[[nodiscard]] std::vector<double> cascade_splits(double near_m, double far_m, std::uint32_t count, bool orthographic);

/// The smallest sphere, centred on the frustum's middle line, that holds the frustum between two view depths. `slice`
/// is 0.
[[nodiscard]] CascadeSphere slice_sphere(const RenderView& view, double near_m, double far_m);

/// The spheres of at most `count` cascades, inner ones first. A slice whose sphere does not touch the casters' bounding
/// sphere is left out. The first slice whose sphere would be at least as large as the casters' bounding sphere gets
/// that sphere instead, and is the last cascade.
[[nodiscard]] std::vector<CascadeSphere> cascade_spheres(const RenderView& view, const CasterBounds& casters,
                                                         std::uint32_t count);

/// The box of a cascade that holds the sphere. square: place in the atlas; its size (> 2) is the resolution. The
/// corners lie on a texel grid fixed to the world (at CasterBounds::grid_anchor), and near and far side lie at steps of
/// a depth grid, so that the map of a moving camera shifts by whole texels. The box reaches along the light as far as
/// casters do; if that is more than depths can hold, as far as the boxes of CasterBounds reach beside the sphere, and
/// kMostReach radii to either side at most. It reaches kReachUnknown radii when the casters' bounds are unknown.
[[nodiscard]] ShadowFace cascade_face(Entity light, const FaceAxes& axes, const CascadeSphere& sphere,
                                      const CasterBounds& casters, const AtlasSquare& square, float kernel_rim);

/// The shader constants of the cascade, for positions relative to view_position (world). kernel_rim: as in
/// cascade_face.
[[nodiscard]] shaders::ShadowCascade cascade_constants(const ShadowFace& face, const dvec3& view_position,
                                                       float kernel_rim);

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// Stable cascades (Valient, "Stable cascaded shadow maps", ShaderX6): each cascade is a box around the bounding sphere
// of a slice of the frustum. The sphere keeps its size when the camera turns, and the box moves by whole texels. In
// addition, a box around all casters replaces the first cascade that would be larger, so small scenes and distant
// cameras get one box that never moves.
#include "modules/shadows/views/cascades.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "engine/core/assert.h"

namespace gloam {
namespace {

constexpr double kLogarithmicShare = 0.9;  // weight of the logarithmic split; the rest is uniform
constexpr double kLeastStart = 1e-3;       // share of the far depth: logarithmic splits begin there or farther
constexpr double kReachUnknown = 256.0;    // radii to each side of a sphere when the casters' bounds are unknown
constexpr double kMostReach = 16384.0;     // most radii to each side of a sphere: depths keep a texel's precision
constexpr double kWideCasters = 256.0;  // radii; of casters that reach farther, only what is beside the sphere counts
constexpr double kLeastDepth = 1e-3;    // least depth of a box, in radii of its sphere
constexpr double kLeastRadius = 1e-12;  // least radius of the casters' sphere, as a share of their coordinates
constexpr double kLeastFar = 1e-3;      // least depth of the cascades, as a share of the near plane's
constexpr double kStepsOfRange = 16.0;  // depth ranges begin and end at multiples of about range / this

/// The least power of two ≥ value.
double power_above(double value) { return std::exp2(std::ceil(std::log2(value))); }

/// The least length ≥ value that is a power of two grid units.
double power_above(double value, const CasterBounds& casters) {
  return power_above(value / casters.grid_unit) * casters.grid_unit;
}

/// Half the size of the box along the world's axes around a box.
dvec3 reach_of(const OrientedBox& box) {
  return glm::abs(box.half_axes[0]) + glm::abs(box.half_axes[1]) + glm::abs(box.half_axes[2]);
}

dvec3 center_of(const CasterBounds& casters) { return (casters.min + casters.max) * 0.5; }

/// Radius of the casters' sphere, rounded up in steps, so that small movements of casters do not change it.
double radius_of(const CasterBounds& casters) {
  const double largest = std::max(glm::length(casters.min), glm::length(casters.max));
  const double radius = std::max({0.5 * glm::length(casters.max - casters.min), kLeastRadius * largest, 1e-30});
  const double step = power_above(radius, casters) / kStepsOfRange;
  return std::ceil(radius / step) * step;
}

/// Rotates a view-space direction into the world, with the same matrix as shading.
dvec3 world_direction(const RenderView& view, const dvec3& in_view) {
  const mat4& m = view.view_from_relative;
  dvec3 world;
  for (int axis = 0; axis < 3; ++axis) world[axis] = glm::dot(dvec3(vec3(m[axis])), in_view);
  return world;
}

bool is_orthographic(const RenderView& view) { return view.clip_from_view[2][3] == 0.0f; }

/// The view-space point with these normalised device coordinates and this view depth, without jitter.
dvec3 view_point(const RenderView& view, double ndc_x, double ndc_y, double depth_m) {
  const mat4 m = view.steady_camera().clip_from_view;
  const double w = is_orthographic(view) ? 1.0 : depth_m;
  const double x = (ndc_x * w + static_cast<double>(m[2][0]) * depth_m - static_cast<double>(m[3][0])) / m[0][0];
  const double y = (ndc_y * w + static_cast<double>(m[2][1]) * depth_m - static_cast<double>(m[3][1])) / m[1][1];
  return {x, y, -depth_m};
}

struct Range {
  double low = 0.0;
  double high = 0.0;
};

/// The range that the casters cover along `forward`, relative to the sphere's centre.
Range extent_along(const CasterBounds& casters, const dvec3& forward, const CascadeSphere& sphere) {
  const double center = glm::dot(forward, center_of(casters) - sphere.center);
  const double half = glm::dot(glm::abs(forward), (casters.max - casters.min) * 0.5);
  return {center - half, center + half};
}

/// The box, or one a little larger, whose half axes span a volume.
OrientedBox with_volume(const OrientedBox& box) {
  const double least = std::max(1e-12 * box.half_diagonal(), 1e-30);
  OrientedBox solid = box;
  for (int axis = 0; axis < 3; ++axis) {
    const dvec3 across = glm::cross(box.half_axes[(axis + 1) % 3], box.half_axes[(axis + 2) % 3]);
    if (glm::length(box.half_axes[axis]) < least && glm::length(across) > 0.0)
      solid.half_axes[axis] = least * glm::normalize(across);
  }
  if (std::abs(glm::determinant(solid.half_axes)) > 0.0) return solid;
  const dvec3 reach = glm::max(reach_of(box), dvec3(least));
  solid.half_axes = glm::dmat3(reach.x, 0.0, 0.0, 0.0, reach.y, 0.0, 0.0, 0.0, reach.z);
  return solid;
}

/// The range along `forward`, relative to the sphere's centre, in which lines parallel to it through the sphere are
/// inside the box, which has a volume. Empty (low > high) if no line meets the box.
Range extent_beside(const OrientedBox& box, const dvec3& forward, const CascadeSphere& sphere) {
  Range range{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  for (int axis = 0; axis < 3; ++axis) {
    // The box is between two planes, whose normal is across the other two axes.
    const dvec3 across = glm::cross(box.half_axes[(axis + 1) % 3], box.half_axes[(axis + 2) % 3]);
    const dvec3 normal = glm::normalize(across);
    const double along = glm::dot(normal, forward);
    if (std::abs(along) < 1e-12) continue;
    const double middle = glm::dot(normal, box.center - sphere.center);
    const double half = std::abs(glm::dot(normal, box.half_axes[axis])) +
                        sphere.radius_m * std::sqrt(std::max(0.0, 1.0 - along * along));
    const double a = (middle - half) / along, b = (middle + half) / along;
    range.low = std::max(range.low, std::min(a, b));
    range.high = std::min(range.high, std::max(a, b));
  }
  return range;
}

/// The range in which lines through the sphere are inside a caster's box.
Range extent_beside(const CasterBounds& casters, const dvec3& forward, const CascadeSphere& sphere) {
  Range all{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  const auto add = [&](const OrientedBox& box) {
    const Range range = extent_beside(with_volume(box), forward, sphere);
    if (range.low <= range.high) all = {std::min(all.low, range.low), std::max(all.high, range.high)};
  };
  for (std::size_t i = 0; i < casters.largest_count; ++i) add(casters.largest[i]);
  if (casters.rest_min.x <= casters.rest_max.x) {
    const dvec3 half = (casters.rest_max - casters.rest_min) * 0.5;
    add({casters.rest_min + half, glm::dmat3(half.x, 0.0, 0.0, 0.0, half.y, 0.0, 0.0, 0.0, half.z)});
  }
  return all;
}

Range depth_range(const CasterBounds& casters, const dvec3& forward, const CascadeSphere& sphere) {
  const double center = glm::dot(forward, sphere.center);
  const double reach = sphere.radius_m * (1.0 + (casters.known() ? kMostReach : kReachUnknown));
  Range range{-reach, reach};
  if (casters.known()) {
    Range covered = extent_along(casters, forward, sphere);
    if (covered.high - covered.low > kWideCasters * sphere.radius_m) covered = extent_beside(casters, forward, sphere);
    const Range both{std::max(range.low, covered.low), std::min(range.high, covered.high)};
    if (both.low <= both.high) range = both;
  }
  range = {center + range.low, center + range.high};
  const double step =
      power_above(std::max(range.high - range.low, kLeastDepth * sphere.radius_m), casters) / kStepsOfRange;
  const double anchor = glm::dot(forward, casters.grid_anchor);
  const double low = std::floor((range.low - anchor) / step) * step + anchor;
  return {low, std::max(std::ceil((range.high - anchor) / step) * step + anchor, low + step)};
}

/// The position with these dot products with the three axes. Axes rounded to floats are only nearly orthogonal: a
/// weighted sum of them would be off by centimetres far from the world's origin.
dvec3 solve(const dvec3& right, const dvec3& up, const dvec3& forward, const dvec3& products) {
  const dvec3 sum = glm::cross(up, forward) * products.x + glm::cross(forward, right) * products.y +
                    glm::cross(right, up) * products.z;
  return sum / glm::dot(right, glm::cross(up, forward));
}

vec4 row_of(const dvec3& axis, double offset) { return vec4(vec3(axis), static_cast<float>(offset)); }

}  // namespace

double OrientedBox::half_diagonal() const {
  return std::sqrt(glm::dot(half_axes[0], half_axes[0]) + glm::dot(half_axes[1], half_axes[1]) +
                   glm::dot(half_axes[2], half_axes[2]));
}

bool CasterBounds::known() const {
  for (int axis = 0; axis < 3; ++axis)
    if (!std::isfinite(min[axis]) || !std::isfinite(max[axis]) || !(min[axis] <= max[axis])) return false;
  return true;
}

double CasterBounds::usual_size() const {
  const std::uint64_t all = std::accumulate(sizes.begin(), sizes.end(), std::uint64_t{0});
  std::uint64_t below = 0;
  for (std::size_t i = 0; i < sizes.size(); ++i)
    if (below += sizes[i]; 2 * below >= all && below > 0)
      return std::min(power_above(std::exp2(log2_sizes / static_cast<double>(all))),
                      std::exp2(static_cast<int>(i) + kLeastExponent + 3)) *
             grid_unit;
  return 0.0;
}

void CasterBounds::add_size(double half_diagonal) {
  if (!(half_diagonal > 0.0) || !std::isfinite(half_diagonal)) return;
  const double log2_size = std::log2(half_diagonal / grid_unit);
  log2_sizes += log2_size;
  const double index = std::ceil(log2_size) - kLeastExponent;
  ++sizes[static_cast<std::size_t>(std::clamp(index, 0.0, static_cast<double>(sizes.size() - 1)))];
}

void CasterBounds::grow(const OrientedBox& box) {
  const dvec3 reach = reach_of(box);
  min = glm::min(min, box.center - reach);
  max = glm::max(max, box.center + reach);
  add_large(box);
}

void CasterBounds::grow(const CasterBounds& other) {
  min = glm::min(min, other.min);
  max = glm::max(max, other.max);
  rest_min = glm::min(rest_min, other.rest_min);
  rest_max = glm::max(rest_max, other.rest_max);
  for (std::size_t i = 0; i < other.largest_count; ++i) add_large(other.largest[i]);
}

void CasterBounds::add_large(const OrientedBox& box) {
  const double size = box.half_diagonal();
  std::size_t at = largest_count;
  while (at > 0 && largest[at - 1].half_diagonal() < size) --at;
  const bool full = largest_count == kLargest;
  if (full) {
    const OrientedBox& smallest = at == kLargest ? box : largest.back();
    const dvec3 reach = reach_of(smallest);
    rest_min = glm::min(rest_min, smallest.center - reach);
    rest_max = glm::max(rest_max, smallest.center + reach);
    if (at == kLargest) return;
  }
  largest_count += full ? 0 : 1;
  std::move_backward(largest.begin() + static_cast<std::ptrdiff_t>(at),
                     largest.begin() + static_cast<std::ptrdiff_t>(largest_count - 1),
                     largest.begin() + static_cast<std::ptrdiff_t>(largest_count));
  largest[at] = box;
}

void CasterBounds::add_sizes(const CasterBounds& other) {
  for (std::size_t i = 0; i < sizes.size(); ++i) sizes[i] += other.sizes[i];
  log2_sizes += other.log2_sizes;
}

double shadow_distance(const RenderView& view, const CasterBounds& casters) {
  const double near_m = std::abs(static_cast<double>(view.near_m));
  if (!casters.known()) return kDefaultShadowDistance * near_m;
  const double radius = radius_of(casters);
  const double to_center = glm::length(view.steady_camera().position - center_of(casters));
  const double distance = 2.0 * radius * std::max(1.0, power_above((to_center + radius) / (2.0 * radius)));
  const double to_casters = std::max(to_center - radius, 0.0);
  const double most = std::max({kMostNearPlanes * near_m, kMostCasterSizes * casters.usual_size(), 1e-30});
  return std::min(distance, most * power_above(1.0 + to_casters / most));
}

std::vector<double> cascade_splits(double near_m, double far_m, std::uint32_t count, bool orthographic) {
  std::vector<double> splits(count);
  const double start = std::max(near_m, far_m * kLeastStart);
  const double share = orthographic || !(start > 0.0) ? 0.0 : kLogarithmicShare;
  for (std::uint32_t i = 0; i < count; ++i) {
    const double t = static_cast<double>(i + 1) / count;
    const double uniform = near_m + (far_m - near_m) * t;
    splits[i] = share == 0.0 ? uniform : share * start * std::pow(far_m / start, t) + (1.0 - share) * uniform;
  }
  if (count > 0) splits.back() = far_m;
  return splits;
}

CascadeSphere slice_sphere(const RenderView& view, double near_m, double far_m) {
  std::array<dvec3, 8> corners;
  // A sphere that followed the jitter would change the cascade's texels in every frame. Half a pixel more at each side
  // holds what any jitter shows.
  const double x = view.jittered ? 1.0 + 1.0 / view.width : 1.0, y = view.jittered ? 1.0 + 1.0 / view.height : 1.0;
  for (std::size_t i = 0; i < corners.size(); ++i)
    corners[i] = view_point(view, (i & 1) == 0 ? -x : x, (i & 2) == 0 ? -y : y, i < 4 ? near_m : far_m);
  const dvec3 first = view_point(view, 0.0, 0.0, near_m);
  const dvec3 last = view_point(view, 0.0, 0.0, far_m);
  const auto radius_at = [&](double t) {
    double squared = 0.0;
    for (const dvec3& corner : corners) {
      const dvec3 to = corner - glm::mix(first, last, t);
      squared = std::max(squared, glm::dot(to, to));
    }
    return std::sqrt(squared);
  };
  // radius_at is convex, as a maximum of convex functions, so a ternary search finds its minimum.
  double low = 0.0;
  double high = 1.0;
  for (int i = 0; i < 60; ++i) {
    const double a = low + (high - low) / 3.0;
    const double b = high - (high - low) / 3.0;
    if (radius_at(a) <= radius_at(b)) {
      high = b;
    } else {
      low = a;
    }
  }
  const double t = 0.5 * (low + high);
  return {0, view.steady_camera().position + world_direction(view, glm::mix(first, last, t)), radius_at(t)};
}

std::vector<CascadeSphere> cascade_spheres(const RenderView& view, const CasterBounds& casters, std::uint32_t count) {
  const bool orthographic = is_orthographic(view);
  const double near_m = view.near_m;
  double far_m = shadow_distance(view, casters);
  if (orthographic) far_m = std::min(far_m, static_cast<double>(view.view_depth(0.0f)));
  std::vector<CascadeSphere> spheres;
  if (!(far_m > near_m)) far_m = near_m + std::max(kLeastFar * std::abs(near_m), 1e-30);
  const std::vector<double> splits = cascade_splits(near_m, far_m, count, orthographic);
  for (std::uint32_t i = 0; i < count; ++i) {
    CascadeSphere sphere = slice_sphere(view, i == 0 ? near_m : splits[i - 1], splits[i]);
    sphere.slice = i;
    if (!casters.known()) {
      spheres.push_back(sphere);
      continue;
    }
    const double radius = radius_of(casters);
    if (sphere.radius_m >= radius) {
      spheres.push_back({i, center_of(casters), radius});
      break;
    }
    if (glm::length(sphere.center - center_of(casters)) <= sphere.radius_m + radius) spheres.push_back(sphere);
  }
  return spheres;
}

ShadowFace cascade_face(Entity light, const FaceAxes& axes, const CascadeSphere& sphere, const CasterBounds& casters,
                        const AtlasSquare& square, float kernel_rim) {
  GLOAM_ASSERT(square.size > 2, "a cascade has a place in the atlas");
  const dvec3 right(axes.right);
  const dvec3 up(axes.up);
  const dvec3 forward(axes.forward);
  // Half extent: the sphere, the rim, and a texel at each side for snapping.
  const double rim = 1.0 + static_cast<double>(kernel_rim);
  ShadowFace face;
  face.half_extent_m = static_cast<float>(sphere.radius_m * rim / (1.0 - 2.0 * rim / square.size));
  const double texel = 2.0 * static_cast<double>(face.half_extent_m) / square.size;
  const auto snapped = [&](const dvec3& axis) {
    const double from_anchor = glm::dot(axis, sphere.center - casters.grid_anchor);
    return std::round(from_anchor / texel) * texel + glm::dot(axis, casters.grid_anchor);
  };
  const Range depths = depth_range(casters, forward, sphere);

  face.light = light;
  face.kind = LightKind::directional;
  face.index = sphere.slice;
  face.origin = solve(right, up, forward, dvec3(snapped(right), snapped(up), depths.low));
  face.right = axes.right;
  face.up = axes.up;
  face.forward = axes.forward;
  face.tan_half = 0.0f;
  face.near_m = 0.0f;
  face.far_m = static_cast<float>(depths.high - depths.low);
  face.square = square;
  return face;
}

shaders::ShadowCascade cascade_constants(const ShadowFace& face, const dvec3& view_position, float kernel_rim) {
  const dvec3 from_origin = view_position - face.origin;
  const double size = face.square.size;
  const double texels_per_m = 0.5 * size / face.half_extent_m;
  const dvec3 u = dvec3(face.right) * texels_per_m;
  const dvec3 v = dvec3(face.up) * -texels_per_m;
  const dvec3 depth = dvec3(face.forward) * (-1.0 / face.far_m);
  shaders::ShadowCascade cascade{};
  cascade.row_u = row_of(u, glm::dot(u, from_origin) + 0.5 * size);
  cascade.row_v = row_of(v, glm::dot(v, from_origin) + 0.5 * size);
  cascade.row_depth = row_of(depth, glm::dot(depth, from_origin) + 1.0);
  cascade.origin = vec2(face.square.origin);
  cascade.size = static_cast<float>(size);
  cascade.texel_m = static_cast<float>(1.0 / texels_per_m);
  cascade.depth_m = face.far_m;
  cascade.rim = static_cast<float>(0.5 * size * kernel_rim / (1.0 + kernel_rim));
  return cascade;
}

}  // namespace gloam

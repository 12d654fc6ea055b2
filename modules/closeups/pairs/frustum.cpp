// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/closeups/pairs/frustum.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "modules/lights/outputs.h"
#include "modules/shadows/components.h"

namespace gloam {
namespace {

constexpr double kNearestShare = 0x1p-44;  // least near plane as a share of the light's range, as in standard maps
constexpr double kWidestTangent = 2.0;
constexpr double kConeRim = 0.125;  // share of the half extent, read by kernels; equals ShadowSettings::kernel_rim
constexpr double kRimTexels = 2.1;  // two, plus a margin for rounding in floats
constexpr double kRounded = 1e-6;   // relative margin for rounding in floats
constexpr double kLeastBox =
    1e-4;  // least half width and depth of a directional light's box, as a share of its surroundings
constexpr std::uint32_t kSmallestMap = 64;

/// Bounds of a box along a map's axes, relative to an origin.
struct AlongAxes {
  dvec3 low = dvec3(std::numeric_limits<double>::infinity());
  dvec3 high = dvec3(-std::numeric_limits<double>::infinity());
};

dvec3 corner_of(const WorldBox& box, int index) {
  return {index & 1 ? box.max.x : box.min.x, index & 2 ? box.max.y : box.min.y, index & 4 ? box.max.z : box.min.z};
}

dvec3 along(const CloseupAxes& axes, const dvec3& v) {
  return {glm::dot(dvec3(axes.right), v), glm::dot(dvec3(axes.up), v), glm::dot(dvec3(axes.forward), v)};
}

AlongAxes along(const CloseupAxes& axes, const WorldBox& box, const dvec3& origin) {
  AlongAxes all;
  for (int c = 0; c < 8; ++c) {
    const dvec3 at = along(axes, corner_of(box, c) - origin);
    all.low = glm::min(all.low, at);
    all.high = glm::max(all.high, at);
  }
  return all;
}

/// Greatest tangent, to either side of the axis, at which a ball is seen. `beside`: distance of its centre from the
/// axis; `ahead`: distance along the axis, > radius.
double widest_tangent(double beside, double ahead, double radius) {
  const double far = std::abs(beside);
  return (far * ahead + radius * std::sqrt(far * far + ahead * ahead - radius * radius)) /
         (ahead * ahead - radius * radius);
}

/// Greatest tangent of the box grown by the emitter's radius; infinite if the grown box reaches the plane through the
/// light. The grown box is bounded by the hull of eight balls, whose greatest tangent is that of one of the balls.
double subject_tangent(const CloseupAxes& axes, const WorldBox& box, const CloseupLight& light) {
  double widest = 0.0;
  for (int c = 0; c < 8; ++c) {
    const dvec3 at = along(axes, corner_of(box, c) - light.position);
    if (!(at.z > light.emitter_radius_m * (1.0 + kRounded))) return std::numeric_limits<double>::infinity();
    widest = std::max({widest, widest_tangent(at.x, at.z, light.emitter_radius_m),
                       widest_tangent(at.y, at.z, light.emitter_radius_m)});
  }
  return widest;
}

/// Share of the half extent that lies inside the border texels (kRimTexels on each side).
double inner_share(std::uint32_t size) { return 1.0 - 2.0 * kRimTexels / static_cast<double>(size); }

ShadowFace looking_along(const CloseupAxes& axes, std::uint32_t size) {
  ShadowFace face;
  face.right = axes.right;
  face.up = axes.up;
  face.forward = axes.forward;
  face.square.size = size;
  return face;
}

std::optional<CloseupFrustum> local_frustum(const CloseupLight& light, const WorldBox& subject, std::uint32_t size) {
  const dvec3 away = light.position - glm::clamp(light.position, subject.min, subject.max);
  if (!(glm::dot(away, away) > light.emitter_radius_m * light.emitter_radius_m)) return std::nullopt;
  const dvec3 middle = (subject.min + subject.max) * 0.5 - light.position;
  if (!(glm::dot(middle, middle) > 0.0)) return std::nullopt;
  CloseupAxes axes = closeup_axes(glm::normalize(middle));
  const double subject_inner = subject_tangent(axes, subject, light) * (1.0 + kRounded);
  const double cone = light.kind == LightKind::spot && light.half_angle < 1.5 ? std::tan(light.half_angle)
                                                                              : std::numeric_limits<double>::infinity();
  const bool by_cone = cone * (1.0 + kConeRim) < subject_inner;
  if (by_cone) axes = {vec3(light.right), vec3(light.up), vec3(light.forward)};
  const double inner = by_cone ? cone : subject_inner;
  const double outer = (by_cone ? inner * (1.0 + kConeRim) : inner) / inner_share(size);
  if (!(outer <= kWidestTangent)) return std::nullopt;

  const AlongAxes extent = along(axes, subject, light.position);
  CloseupFrustum frustum;
  frustum.face = looking_along(axes, size);
  frustum.face.kind = LightKind::spot;
  frustum.face.origin = light.position;
  frustum.face.tan_half = static_cast<float>(outer);
  frustum.face.near_m = static_cast<float>(std::max(kNearestShare * light.range_m, extent.low.z * (1.0 - kRounded)));
  frustum.face.far_m = static_cast<float>(light.range_m);
  frustum.face.bulb_radius_m = static_cast<float>(std::max(light.emitter_radius_m, kLeastBulb * light.range_m));
  frustum.tan_inner = static_cast<float>(inner);
  if (!(extent.high.z > frustum.face.near_m) || !(frustum.face.near_m < frustum.face.far_m)) return std::nullopt;
  return frustum;
}

std::optional<CloseupFrustum> directional_frustum(const CloseupLight& light, const WorldBox& subject,
                                                  const WorldBox& receivers, std::uint32_t size) {
  const CloseupAxes axes = closeup_axes(light.forward);
  const dvec3 middle = (subject.min + subject.max) * 0.5;
  const AlongAxes extent = along(axes, subject, middle);
  double far = extent.high.z;
  if (receivers.known()) far = std::max(far, along(axes, receivers, middle).high.z);
  const double wide = std::max({extent.high.x, -extent.low.x, extent.high.y, -extent.low.y});
  const double least = std::max(kLeastBox * std::max(wide, far - extent.low.z), 1e-30);
  const double depth = std::max(far - extent.low.z, least), half = std::max(wide, least);
  CloseupFrustum frustum;
  frustum.face = looking_along(axes, size);
  frustum.face.kind = LightKind::directional;
  const double slack = kRounded * (half + depth);
  frustum.face.origin = middle + dvec3(axes.forward) * (extent.low.z - slack);
  frustum.face.tan_half = 0.0f;
  frustum.face.near_m = 0.0f;
  frustum.face.far_m = static_cast<float>(depth + 2.0 * slack);
  frustum.face.half_extent_m = static_cast<float>((half + light.spread * depth + slack) / inner_share(size));
  const bool finite = std::isfinite(frustum.face.far_m) && std::isfinite(frustum.face.half_extent_m);
  return finite ? std::optional(frustum) : std::nullopt;
}

}  // namespace

CloseupAxes closeup_axes(const dvec3& forward) {
  // Rotates the axes that look straight down, by the shortest rotation to `forward`.
  const dvec3 down(0.0, -1.0, 0.0);
  const double turned = 1.0 + glm::dot(down, forward);
  dvec3 right(1.0, 0.0, 0.0);
  if (turned > 1e-12) right -= (down + forward) * (forward.x / turned);
  right = glm::normalize(right - forward * glm::dot(right, forward));
  return {vec3(right), vec3(glm::cross(right, forward)), vec3(forward)};
}

std::optional<CloseupFrustum> closeup_frustum(const CloseupLight& light, const WorldBox& subject,
                                              const WorldBox& receivers, std::uint32_t size) {
  if (!subject.known() || size < kSmallestMap) return std::nullopt;
  return light.kind == LightKind::directional ? directional_frustum(light, subject, receivers, size)
                                              : local_frustum(light, subject, size);
}

std::uint32_t closeup_size(const CloseupSettings& settings, const TileRange& tiles) {
  const std::uint32_t room = std::max(settings.batch > 1 ? settings.map_size / 2 : settings.map_size, kSmallestMap);
  if (tiles.empty() || !(settings.texels_per_pixel > 0.0f)) return kSmallestMap;
  const std::uint32_t side = std::max(tiles.end.x - tiles.begin.x, tiles.end.y - tiles.begin.y) * kShadowTile;
  const double texels = static_cast<double>(side) * static_cast<double>(settings.texels_per_pixel);
  if (texels >= static_cast<double>(room)) return room;
  return std::clamp(std::bit_ceil(static_cast<std::uint32_t>(std::ceil(texels))), kSmallestMap, room);
}

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/views/faces.h"

#include <algorithm>
#include <cmath>

#include "engine/core/assert.h"
#include "engine/math/finite.h"
#include "modules/shadows/views/bulbs.h"

namespace gloam {
namespace {

constexpr float kWidestSpot = kPi / 3.0f * 1.0001f;  // half angle in radians: wider cones get a cube
constexpr float kNarrowestSpot = kPi / 180.0f;       // half angle in radians
constexpr float kWidestCookie = kPi * 0.47f;         // half angle in radians: below 90°, which has no tangent
/// Boxes are enlarged by this share of the lengths involved, as axes are floats.
constexpr double kBoundsRounding = 1e-6;

/// The unit vector of v; zero when v is zero or not finite.
dvec3 direction_of(const dvec3& v) {
  const double greatest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  if (!is_finite(v) || !(greatest > 0.0)) return dvec3(0.0);
  return glm::normalize(v / greatest);
}

/// The part of unit vector v orthogonal to unit vector `axis`, normalised; zero when they are nearly parallel.
dvec3 beside(const dvec3& v, const dvec3& axis) {
  const dvec3 part = v - axis * glm::dot(v, axis);
  return glm::dot(part, part) > 1e-12 ? glm::normalize(part) : dvec3(0.0);
}

dvec3 any_beside(const dvec3& axis) {
  const dvec3 a = glm::abs(axis);
  const dvec3 other = a.x <= a.y && a.x <= a.z ? dvec3(1.0, 0.0, 0.0)
                      : a.y <= a.z             ? dvec3(0.0, 1.0, 0.0)
                                               : dvec3(0.0, 0.0, 1.0);
  return glm::normalize(glm::cross(axis, other));
}

}  // namespace

FaceAxes node_axes(const dmat4& world_from_node) {
  const dvec3 x = direction_of(dvec3(world_from_node[0]));
  const dvec3 y = direction_of(dvec3(world_from_node[1]));
  dvec3 forward = -direction_of(dvec3(world_from_node[2]));
  if (forward == dvec3(0.0)) forward = dvec3(0.0, 0.0, -1.0);
  dvec3 right = beside(x, forward);
  if (right == dvec3(0.0)) right = glm::cross(forward, beside(y, forward));
  if (right == dvec3(0.0)) right = any_beside(forward);
  const dvec3 up = glm::cross(right, forward);
  const bool mirrored = glm::dot(up, y) < 0.0;
  return {vec3(right), vec3(mirrored ? -up : up), vec3(forward)};
}

FaceAxes cube_axes(std::uint32_t face) {
  GLOAM_ASSERT(face < 6, "a cube has six faces");
  vec3 forward(0.0f);
  forward[static_cast<int>(face / 2)] = face % 2 == 0 ? 1.0f : -1.0f;
  const vec3 up = face / 2 == 1 ? vec3(0.0f, 0.0f, -forward.y) : vec3(0.0f, 1.0f, 0.0f);
  const mat3 cube(GLOAM_CUBE_X, GLOAM_CUBE_Y, GLOAM_CUBE_Z);
  return {cube * glm::cross(forward, up), cube * up, cube * forward};
}

std::uint32_t cube_face_of(const dvec3& direction) {
  const dvec3 in_cube = direction * glm::dmat3(mat3(GLOAM_CUBE_X, GLOAM_CUBE_Y, GLOAM_CUBE_Z));
  const dvec3 a = glm::abs(in_cube);
  const std::uint32_t axis = a.x >= a.y && a.x >= a.z ? 0 : a.y >= a.z ? 1 : 2;
  return axis * 2 + (in_cube[static_cast<int>(axis)] < 0.0 ? 1 : 0);
}

LocalShadow local_shadow(const Light& light, const dmat4& world_from_node, float kernel_rim, bool d16) {
  LocalShadow shadow;
  shadow.position = dvec3(world_from_node[3]);
  shadow.axes = node_axes(world_from_node);
  shadow.range_m = effective_range(light);
  shadow.emitter_diameter_m = light.width_m > 0.0f && std::isfinite(light.width_m) ? light.width_m : 0.0f;
  shadow.bulb_radius_m = static_cast<float>(bulb_radius(light));
  const bool spot = light.kind == LightKind::spot;
  const bool sound = is_finite(shadow.position) && (!spot || std::isfinite(light.outer_angle));
  const float half = spot && sound ? std::clamp(light.outer_angle, 0.0f, kPi * 0.5f) : kPi * 0.5f;
  if (spot) shadow.cookie_tan = std::tan(std::clamp(half, kNarrowestSpot, kWidestCookie));
  if (!sound || light.kind == LightKind::directional) return shadow;
  const bool one_face = spot && half <= kWidestSpot;
  shadow.kind = one_face ? GLOAM_SHADOW_SPOT : GLOAM_SHADOW_CUBE;
  shadow.near_m = shadow.range_m * (d16 ? kNearShare16 : kNearShare);
  shadow.clip_share = d16 ? kNearShare / kNearShare16 : 1.0f;
  shadow.tan_inner = one_face ? shadow.cookie_tan : 1.0f;
  shadow.tan_half = shadow.tan_inner * (1.0f + kernel_rim);
  return shadow;
}

ShadowFace local_face(Entity light, const LocalShadow& shadow, std::uint32_t index) {
  GLOAM_ASSERT(index < shadow.face_count(), "the light has no such face");
  const bool cube = shadow.kind == GLOAM_SHADOW_CUBE;
  const FaceAxes axes = cube ? cube_axes(index) : shadow.axes;
  ShadowFace face;
  face.light = light;
  face.kind = cube ? LightKind::point : LightKind::spot;
  face.index = index;
  face.origin = shadow.position;
  face.right = axes.right;
  face.up = axes.up;
  face.forward = axes.forward;
  face.tan_half = shadow.tan_half;
  face.near_m = shadow.near_m;
  face.far_m = shadow.range_m;
  face.clip_share = shadow.clip_share;
  face.bulb_radius_m = shadow.bulb_radius_m;
  return face;
}

shaders::ShadowRow shadow_row(const LocalShadow& shadow, std::span<const AtlasSquare> squares) {
  shaders::ShadowRow row{};
  row.near_m = shadow.near_m;
  row.emitter_diameter_m = shadow.emitter_diameter_m;
  row.right = shadow.axes.right;
  row.up = shadow.axes.up;
  row.tan_half = shadow.tan_half;
  row.tan_inner = shadow.tan_inner;
  row.cookie_layer = -1.0f;
  row.cookie_tan = shadow.cookie_tan;
  row.traced_layer = -1.0f;
  row.mirrored = glm::dot(glm::cross(shadow.axes.up, shadow.axes.right), shadow.axes.forward) < 0.0f ? 1.0f : 0.0f;
  if (squares.empty()) return row;
  GLOAM_ASSERT(squares.size() == shadow.face_count(), "every face of a light has a place, or none");
  row.kind = static_cast<float>(shadow.kind);
  row.size = static_cast<float>(squares[0].size);
  for (std::size_t i = 0; i < squares.size(); ++i) {
    GLOAM_ASSERT(squares[i].size == squares[0].size, "a light's faces have one size");
    row.origins[i] = vec2(squares[i].origin);
  }
  return row;
}

std::optional<FacePoint> project(const ShadowFace& face, const dvec3& world) {
  const dvec3 p = world - face.origin;
  const double x = glm::dot(dvec3(face.right), p);
  const double y = glm::dot(dvec3(face.up), p);
  const double z = glm::dot(dvec3(face.forward), p);
  const bool perspective = face.tan_half > 0.0f;
  if (perspective && !(z > 0.0)) return std::nullopt;
  const double half = perspective ? z * face.tan_half : static_cast<double>(face.half_extent_m);
  const double side = face.square.size;
  return FacePoint{(0.5 + 0.5 * x / half) * side, (0.5 - 0.5 * y / half) * side,
                   perspective ? face.near_m / z : 1.0 - z / face.far_m, z};
}

dvec3 unproject(const ShadowFace& face, double x, double y, double along_m) {
  const double half = face.tan_half > 0.0f ? along_m * face.tan_half : static_cast<double>(face.half_extent_m);
  const double side = face.square.size;
  return face.origin + dvec3(face.right) * ((2.0 * x / side - 1.0) * half) +
         dvec3(face.up) * ((1.0 - 2.0 * y / side) * half) + dvec3(face.forward) * along_m;
}

bool face_may_see(const ShadowFace& face, const dvec3& min, const dvec3& max) {
  if (!(min.x <= max.x && min.y <= max.y && min.z <= max.z)) return true;
  const dvec3 center = (min + max) * 0.5 - face.origin;
  const dvec3 half = (max - min) * 0.5;
  const double slack =
      kBoundsRounding * (std::abs(center.x) + std::abs(center.y) + std::abs(center.z) + half.x + half.y + half.z);
  // How far the box extends from the face's origin along v. NaN makes all comparisons below false, so the box counts as
  // seen.
  const auto reach = [&](const dvec3& v) { return glm::dot(v, center) + glm::dot(glm::abs(v), half) + slack; };
  const dvec3 right(face.right);
  const dvec3 up(face.up);
  const dvec3 forward(face.forward);
  if (face.tan_half > 0.0f) {
    const dvec3 ahead = forward * static_cast<double>(face.tan_half);
    for (const dvec3& side : {ahead + right, ahead - right, ahead + up, ahead - up})
      if (reach(side) < 0.0) return false;
    if (reach(forward) < face.clip_m()) return false;
    const dvec3 nearest = glm::max(glm::abs(center) - half, dvec3(0.0));
    return !(glm::length(nearest) - slack > face.far_m);
  }
  const double extent = face.half_extent_m;
  for (const dvec3& side : {right, -right, up, -up})
    if (reach(side) < -extent) return false;
  return !(-reach(-forward) > face.far_m);
}

}  // namespace gloam

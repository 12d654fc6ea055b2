// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/closeups/umbra/umbra_projection.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "engine/math/screen_bounds.h"
#include "modules/closeups/umbra/hull_on_screen.h"
#include "modules/lights/components.h"

namespace gloam {
namespace {

using glm::dvec2;

constexpr double kSlackPixels = 1.0 / 16.0;  // rounding of the camera's float matrices and of positions from depth
constexpr double kCellAngle = 0.3;           // greatest width of a cell of the far end, radians
constexpr double kLeastCellAngle = 0.1;      // width of its cells for narrow cones, radians
constexpr std::size_t kDiscCorners = 8;      // corners of the polygon around a directional light's disc
constexpr double kLeastSlope = 0.05;         // rays flatter than this to a side of the scene are not followed to it
constexpr double kFarthestCone = 1e4;        // metres: an apex farther away is too imprecise in floats

/// The camera, for world positions in double.
struct CameraFrame {
  const ViewProjection& view;
  glm::dmat3 turn;

  explicit CameraFrame(const ViewProjection& v) : view(v), turn(glm::mat3(v.view_from_relative)) {}
  [[nodiscard]] dvec3 seen(const dvec3& world) const { return turn * (world - view.position); }
};

TileRange whole_view(const ViewProjection& view) {
  return {uvec2(0), {(view.width + kShadowTile - 1) / kShadowTile, (view.height + kShadowTile - 1) / kShadowTile}};
}

ScreenRect screen_with_slack(const ViewProjection& view) {
  const dvec2 slack = 2.0 * kSlackPixels / dvec2(view.width, view.height);
  return {-1.0 - slack, 1.0 + slack};
}

TileRange tiles_of(const ScreenRect& rect, const ViewProjection& view) {
  if (rect.empty()) return {};
  const dvec2 size(view.width, view.height);
  const dvec2 low = (dvec2(rect.low.x, -rect.high.y) * 0.5 + 0.5) * size - kSlackPixels;
  const dvec2 high = (dvec2(rect.high.x, -rect.low.y) * 0.5 + 0.5) * size + kSlackPixels;
  if (high.x < 0.0 || high.y < 0.0 || low.x >= size.x || low.y >= size.y) return {};
  const uvec2 first(glm::max(low, dvec2(0.0)));
  const uvec2 last(glm::min(high, size - 1.0));
  return {first / kShadowTile, last / kShadowTile + 1u};
}

void cut_off(const NdcRect& rect, const ViewProjection& view, ScreenRect& limit) {
  const dvec2 slack = 2.0 * kSlackPixels / dvec2(view.width, view.height);
  if (rect.empty) {
    limit = {dvec2(1.0), dvec2(-1.0)};
    return;
  }
  limit.low = glm::max(limit.low, dvec2(rect.min) - slack);
  limit.high = glm::min(limit.high, dvec2(rect.max) + slack);
}

/// The part of the screen that the light can reach.
ScreenRect light_limit(const CloseupLight& light, const CameraFrame& camera) {
  const ViewProjection& view = camera.view;
  ScreenRect limit = screen_with_slack(view);
  const mat4& clip = view.clip_from_view;
  const dvec3 at = camera.seen(light.position);
  const double radius = light.range_m * (1.0 + 1e-5) + glm::length(at) * 1e-6;
  if (clip[3][3] == 1.0f) {  // orthographic
    const dvec2 middle(static_cast<double>(clip[0][0]) * at.x + static_cast<double>(clip[3][0]),
                       static_cast<double>(clip[1][1]) * at.y + static_cast<double>(clip[3][1]));
    const dvec2 reach = radius * dvec2(clip[0][0], clip[1][1]);
    limit.low = glm::max(limit.low, middle - reach);
    limit.high = glm::min(limit.high, middle + reach);
    return limit;
  }
  if (clip[2][0] != 0.0f || clip[2][1] != 0.0f) return limit;  // off-centre
  const PerspectiveScale scale{vec2(clip[0][0], clip[1][1]), view.near_m};
  cut_off(screen_bounds(Sphere{vec3(at), static_cast<float>(radius)}, scale), view, limit);
  if (light.kind != LightKind::spot || glm::length(at) > kFarthestCone) return limit;
  const auto half_angle = std::min(static_cast<float>(light.half_angle) + 1e-4f, kPi * 0.5f);
  const Cone cone{vec3(at), vec3(camera.turn * light.forward), half_angle, static_cast<float>(radius)};
  cut_off(screen_bounds(cone, scale), view, limit);
  return limit;
}

std::array<dvec3, 8> corners_of(const WorldBox& box) {
  std::array<dvec3, 8> corners;
  for (std::size_t c = 0; c < 8; ++c)
    corners[c] = {c & 1 ? box.max.x : box.min.x, c & 2 ? box.max.y : box.min.y, c & 4 ? box.max.z : box.min.z};
  return corners;
}

/// Positions along one side of a box face at distance `ahead`, at equal angles as seen from the light.
std::vector<double> steps(double from, double to, double ahead, double cell_angle) {
  const double first = std::atan2(from, ahead);
  const double span = std::atan2(to, ahead) - first;
  const int cells = std::max(static_cast<int>(std::ceil(span / cell_angle)), 1);
  std::vector<double> at(static_cast<std::size_t>(cells) + 1, to);
  at[0] = from;
  for (int i = 1; i < cells; ++i) at[static_cast<std::size_t>(i)] = ahead * std::tan(first + span * i / cells);
  return at;
}

/// Directions within an angle of an axis.
struct Directions {
  dvec3 axis = dvec3(0.0, 0.0, -1.0);
  double half_angle = 2.0 * static_cast<double>(kPi);
  /// Whether a direction within acos(cosine) of `middle` may be one of these.
  [[nodiscard]] bool may_meet(const dvec3& middle, double cosine) const {
    const double between = std::acos(std::clamp(glm::dot(middle, axis), -1.0, 1.0));
    return between <= half_angle + std::acos(std::clamp(cosine, -1.0, 1.0)) + 1e-6;
  }
};

/// Adds points, relative to the light. In every direction of `wanted` that meets this face of the box, their hull lies
/// beyond `range`. `ahead`: signed position of the face on `axis`.
void add_far_end(const dvec3& low, const dvec3& high, int axis, double ahead, double range, const Directions& wanted,
                 std::vector<dvec3>& points) {
  const int u = (axis + 1) % 3;
  const int v = (axis + 2) % 3;
  const double cell_angle = std::clamp(0.5 * wanted.half_angle, kLeastCellAngle, kCellAngle);
  const std::vector<double> us = steps(low[u], high[u], std::abs(ahead), cell_angle);
  const std::vector<double> vs = steps(low[v], high[v], std::abs(ahead), cell_angle);
  const auto direction = [&](std::size_t i, std::size_t j) {
    dvec3 d;
    d[axis] = ahead;
    d[u] = us[i];
    d[v] = vs[j];
    return glm::normalize(d);
  };
  // Moves the corners of a cell out to a plane perpendicular to its middle direction, so that the whole cell lies
  // beyond the range.
  std::vector<double> reach(us.size() * vs.size(), 0.0);
  for (std::size_t i = 0; i + 1 < us.size(); ++i) {
    for (std::size_t j = 0; j + 1 < vs.size(); ++j) {
      const std::array<dvec3, 4> corners{direction(i, j), direction(i + 1, j), direction(i, j + 1),
                                         direction(i + 1, j + 1)};
      const dvec3 middle = glm::normalize(corners[0] + corners[1] + corners[2] + corners[3]);
      double least = 1.0;
      for (const dvec3& corner : corners) least = std::min(least, glm::dot(middle, corner));
      if (!wanted.may_meet(middle, least)) continue;
      const double out = range / least * (1.0 + 1e-9);
      for (const std::size_t at :
           {i * vs.size() + j, (i + 1) * vs.size() + j, i * vs.size() + j + 1, (i + 1) * vs.size() + j + 1})
        reach[at] = std::max(reach[at], out);
    }
  }
  for (std::size_t i = 0; i < us.size(); ++i)
    for (std::size_t j = 0; j < vs.size(); ++j)
      if (const double out = reach[i * vs.size() + j]; out > 0.0) points.push_back(direction(i, j) * out);
}

void add_far_end(const WorldBox& grown, double range, const Directions& wanted, std::vector<dvec3>& points) {
  for (int axis = 0; axis < 3; ++axis) {
    if (grown.min[axis] > 0.0) add_far_end(grown.min, grown.max, axis, grown.min[axis], range, wanted, points);
    if (grown.max[axis] < 0.0) add_far_end(grown.min, grown.max, axis, grown.max[axis], range, wanted, points);
  }
}

/// Box around the light's cone, with the apex at the origin, up to the light's range.
WorldBox cone_box(const CloseupLight& light) {
  WorldBox box{dvec3(0.0), dvec3(0.0)};
  for (int axis = 0; axis < 3; ++axis) {
    const double angle = std::acos(std::clamp(light.forward[axis], -1.0, 1.0));
    const double half = light.half_angle + 1e-6;
    box.max[axis] = std::max(std::cos(std::max(angle - half, 0.0)), 0.0) * light.range_m;
    box.min[axis] = std::min(std::cos(std::min(angle + half, static_cast<double>(kPi))), 0.0) * light.range_m;
  }
  return box;
}

ScreenRect hull_round_light(std::vector<dvec3> points, const WorldBox& near_end, const CloseupLight& light,
                            const CameraFrame& camera, const ScreenRect& limit) {
  for (const dvec3& corner : corners_of(near_end)) points.push_back(corner);
  for (dvec3& point : points) point = camera.seen(light.position + point);
  return hull_on_screen(points, camera.view, limit);
}

/// Proof that the hulls contain every shadowed receiver. Let a point B of the box hide a point E of the emitter from
/// the receiver. The receiver lies on the ray from B along B − E. As seen from the emitter's centre, B − E points to
/// the box grown by the emitter's radius. The far end covers all of these directions and the ray leaves the range
/// through it, so the receiver is in the hull of the box and the far end. The receiver also lies behind a point of the
/// grown box in its own direction. If it is in a spot's cone, it is therefore in the hull of the parts of the grown box
/// and of the far end that the cone may meet.
TileRange local_tiles(const CloseupLight& light, const WorldBox& subject, const CameraFrame& camera) {
  ScreenRect limit = light_limit(light, camera);
  const double range = light.range_m;
  const WorldBox box{glm::max(subject.min - light.position, dvec3(-range)),
                     glm::min(subject.max - light.position, dvec3(range))};
  if (!box.known()) return {};
  WorldBox grown{box.min - light.emitter_radius_m, box.max + light.emitter_radius_m};
  const dvec3 ahead = glm::max(grown.min, -grown.max);
  // The light is inside the grown box: the shadow may fall in any direction.
  const bool around = !(std::max({ahead.x, ahead.y, ahead.z}) > 1e-9 * range);
  if (around) return tiles_of(limit, camera.view);
  std::vector<dvec3> points;
  add_far_end(grown, range, {}, points);
  limit = hull_round_light(points, box, light, camera, limit);
  if (light.kind == LightKind::spot && !limit.empty()) {
    points.clear();
    add_far_end(grown, range, {light.forward, light.half_angle}, points);
    const WorldBox cone = cone_box(light);
    grown = {glm::max(grown.min, cone.min), glm::min(grown.max, cone.max)};
    if (!grown.known() || points.empty()) return {};
    limit = hull_round_light(points, grown, light, camera, limit);
  }
  return tiles_of(limit, camera.view);
}

/// Directions whose hull holds the directions of all rays of the light.
std::vector<dvec3> arriving(const CloseupLight& light) {
  if (!(light.spread > 0.0)) return {light.forward};
  std::vector<dvec3> rays;
  const double out = light.spread / std::cos(static_cast<double>(kPi) / kDiscCorners) * (1.0 + 1e-9);
  for (std::size_t k = 0; k < kDiscCorners; ++k) {
    const double angle = 2.0 * static_cast<double>(kPi) * static_cast<double>(k) / kDiscCorners;
    rays.push_back(light.forward + (light.right * std::cos(angle) + light.up * std::sin(angle)) * out);
  }
  return rays;
}

/// Screen bounds of the hull of the box corners and of the points where `rays` from these corners meet a plane. Any ray
/// inside the hull of `rays`, from any point of the box, meets the plane inside this hull.
ScreenRect followed_to(const dvec3& normal, double distance, std::span<const dvec3> rays,
                       const std::array<dvec3, 8>& corners, const CameraFrame& camera, const ScreenRect& limit) {
  std::vector<dvec3> points;
  for (const dvec3& corner : corners) {
    points.push_back(camera.seen(corner));
    const double left = std::max(distance - glm::dot(normal, corner), 0.0);
    for (const dvec3& ray : rays) points.push_back(camera.seen(corner + ray * (left / glm::dot(normal, ray))));
  }
  return hull_on_screen(points, camera.view, limit);
}

/// All receivers are inside the scene's box. The shadow volume up to a side that the light shines toward therefore
/// holds all receivers; the result is the intersection over these sides.
TileRange directional_tiles(const CloseupLight& light, const WorldBox& subject, const WorldBox& receivers,
                            const CameraFrame& camera) {
  WorldBox scene = subject;
  if (receivers.known()) scene = {glm::min(scene.min, receivers.min), glm::max(scene.max, receivers.max)};
  const dvec3 pad = (scene.max - scene.min) * 1e-6 + 1e-4;
  scene = {scene.min - pad, scene.max + pad};
  const std::array<dvec3, 8> corners = corners_of(subject);
  const std::array<dvec3, 8> ends = corners_of(scene);
  const std::vector<dvec3> rays = arriving(light);
  std::array<dvec3, 8> seen_ends;
  std::ranges::transform(ends, seen_ends.begin(), [&](const dvec3& end) { return camera.seen(end); });
  ScreenRect rect = hull_on_screen(seen_ends, camera.view, screen_with_slack(camera.view));
  bool followed = false;
  for (int axis = 0; axis < 3; ++axis) {
    const double sign = light.forward[axis] < 0.0 ? -1.0 : 1.0;
    if (std::ranges::any_of(rays, [&](const dvec3& ray) { return !(sign * ray[axis] > kLeastSlope); })) continue;
    dvec3 normal(0.0);
    normal[axis] = sign;
    const double distance = sign > 0.0 ? scene.max[axis] : -scene.min[axis];
    rect = followed_to(normal, distance, rays, corners, camera, rect);
    followed = true;
  }
  if (!followed) {
    double distance = glm::dot(light.forward, ends[0]);
    for (const dvec3& end : ends) distance = std::max(distance, glm::dot(light.forward, end));
    rect = followed_to(light.forward, distance, rays, corners, camera, rect);
  }
  return tiles_of(rect, camera.view);
}

bool finite_light(const CloseupLight& light) {
  const dvec3 sum = light.position + light.forward + light.right + light.up;
  return std::isfinite(sum.x + sum.y + sum.z + light.emitter_radius_m + light.range_m + light.spread +
                       light.half_angle);
}

}  // namespace

TileRange umbra_tiles(const CloseupLight& light, const WorldBox& subject, const WorldBox& receivers,
                      const ViewProjection& view) {
  const CameraFrame camera(view);
  const bool finite_view = std::isfinite(view.position.x + view.position.y + view.position.z);
  if (!finite_view || !finite_light(light) || !subject.known()) return whole_view(view);
  return light.kind == LightKind::directional ? directional_tiles(light, subject, receivers, camera)
                                              : local_tiles(light, subject, camera);
}

TileRange box_tiles(const WorldBox& box, const ViewProjection& view) {
  const dvec3 sum = box.min + box.max + view.position;
  if (!box.known() || !std::isfinite(sum.x + sum.y + sum.z)) return whole_view(view);
  const CameraFrame camera(view);
  std::array<dvec3, 8> corners = corners_of(box);
  for (dvec3& corner : corners) corner = camera.seen(corner);
  return tiles_of(hull_on_screen(corners, view, screen_with_slack(view)), view);
}

}  // namespace gloam

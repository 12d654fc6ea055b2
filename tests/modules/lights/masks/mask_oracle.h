// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/ext/matrix_transform.hpp>
#include <iomanip>
#include <optional>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "engine/render/view.h"
#include "modules/lights/masks/tile_light_masks.h"
#include "tests/math/silhouette.h"

/// Brute-force oracle of tile light masks, in double. It projects points of a light's volume one by one, and the tile
/// that shows a point must have the light's bit. All points are inside the volume, so the oracle never demands too
/// much.
namespace gloam::test {

/// Random numbers of one scene, from one seed.
class SceneRandom {
 public:
  explicit SceneRandom(std::uint32_t seed) : engine_(seed) {}
  double between(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine_()) / 4294967296.0);
  }
  double length(double low, double high) { return std::pow(10.0, between(low, high)); }  ///< 10^low…10^high metres
  int index(int count) { return static_cast<int>(engine_() % static_cast<std::uint32_t>(count)); }
  bool one_in(int count) { return index(count) == 0; }
  dvec3 direction() {
    if (one_in(8)) {
      dvec3 axis(0.0);
      axis[index(3)] = one_in(2) ? -1.0 : 1.0;
      return axis;
    }
    const double z = between(-1.0, 1.0);
    const double turn = between(0.0, 2.0 * 3.14159265358979323846);
    const double across = std::sqrt(1.0 - z * z);
    return {across * std::cos(turn), across * std::sin(turn), z};
  }

 private:
  std::mt19937 engine_;
};

/// A rigid matrix with a random rotation.
inline dmat4 draw_pose(SceneRandom& random, const dvec3& position) {
  dmat4 pose = glm::rotate(dmat4(1.0), random.between(-3.2, 3.2), random.direction());
  pose[3] = dvec4(position, 1.0);
  return pose;
}

/// Moves the centre of the picture off the camera's axis, in halves of the picture.
inline void shift_off_centre(RenderView& view, double x, double y) {
  const int column = view.camera.orthographic ? 3 : 2;
  view.clip_from_view[column][0] = static_cast<float>(x);
  view.clip_from_view[column][1] = static_cast<float>(y);
  view.clip_from_relative = view.clip_from_view * view.view_from_relative;
  view.frustum = frustum_from_clip(view.clip_from_relative);
}

inline RenderView draw_view(SceneRandom& random) {
  static constexpr uvec2 kSizes[] = {{1, 1},     {7, 5},     {33, 31},  {32, 32},  {64, 33},
                                     {257, 129}, {320, 180}, {97, 500}, {500, 97}, {640, 360}};
  ViewSettings settings;
  const uvec2 size = random.one_in(80) ? uvec2(4095, 2161) : kSizes[random.index(10)];
  settings.width = size.x;
  settings.height = size.y;
  settings.world_from_camera = draw_pose(random, random.direction() * random.length(-1.0, 5.0));
  settings.camera.orthographic = random.one_in(4);
  settings.camera.half_height_m = static_cast<float>(random.length(-1.0, 3.0));
  settings.camera.near_m = static_cast<float>(random.one_in(3) ? random.length(-4.0, 1.0) : 0.1);
  settings.camera.fov_y = static_cast<float>(random.one_in(3) ? random.between(0.02, 3.0) : 1.0);
  RenderView view = make_view(settings, 0);
  if (random.one_in(3)) shift_off_centre(view, random.between(-1.5, 1.5), random.between(-1.5, 1.5));
  return view;
}

inline MaskLight point_mask_light(const dvec3& position, double range) {
  MaskLight light;
  light.apex = vec3(position);
  light.range_m = static_cast<float>(range);
  light.bounds = {light.apex, light.range_m};
  return light;
}

inline MaskLight spot_mask_light(const dvec3& apex, const dvec3& direction, double half_angle, double range) {
  MaskLight light;
  light.apex = vec3(apex);
  light.direction = glm::normalize(vec3(direction));
  light.cos_outer = static_cast<float>(std::max(0.0, std::cos(half_angle)));
  light.range_m = static_cast<float>(range);
  // The angle of the rounded cosine.
  const auto angle = static_cast<float>(std::acos(static_cast<double>(light.cos_outer)));
  light.bounds = bounding_sphere(Cone{light.apex, light.direction, angle, light.range_m});
  return light;
}

/// Camera-relative position of a point in view space.
inline dvec3 relative_of_view(const RenderView& view, const dvec3& in_view) {
  return dvec3(glm::transpose(dmat4(view.view_from_relative)) * dvec4(in_view, 1.0));
}

/// A light near the visible volume: in front of, behind or around the camera, or touching the near plane from either
/// side.
inline MaskLight draw_mask_light(SceneRandom& random, const RenderView& view) {
  const double range = random.one_in(20) ? 0.0 : random.one_in(4) ? random.length(-4.0, 5.0) : random.length(-1.0, 1.3);
  const double depth = random.one_in(4) ? random.length(-2.0, 5.0) : random.length(-0.5, 2.0);
  const dmat4 view_from_clip = glm::inverse(dmat4(view.clip_from_view));
  const double spread = random.one_in(3) ? 2.0 : 1.0;
  const dvec4 on_near =
      view_from_clip * dvec4(random.between(-spread, spread), random.between(-spread, spread), 1.0, 1.0);
  dvec3 in_view = dvec3(on_near) / on_near.w;
  if (view.camera.orthographic)
    in_view.z = -depth;
  else
    in_view *= depth / -in_view.z;
  switch (random.index(10)) {
    case 0:
      in_view = random.direction() * (range * random.between(0.0, 2.0));
      break;
    case 1:
      in_view.z = -static_cast<double>(view.near_m) + range * (random.one_in(2) ? 1.0 : random.between(-1.2, 1.2));
      break;
    case 2:
      in_view = -in_view;
      break;
    default:
      break;
  }
  const dvec3 position = relative_of_view(view, in_view);
  if (random.one_in(2)) return point_mask_light(position, range);
  static constexpr double kAngles[] = {0.0, 1e-3, 0.785398163397448, 1.0471975511965976, 1.5707963267948966};
  const double half_angle = random.one_in(3) ? kAngles[random.index(5)] : random.between(0.01, 1.5707);
  return spot_mask_light(position, random.direction(), half_angle, range);
}

/// The tile that shows the point; none if the point is not visible or within a hundredth of a pixel of another tile.
inline std::optional<uvec2> tile_of(const RenderView& view, const dvec3& point) {
  const dvec4 clip = dmat4(view.clip_from_relative) * dvec4(point, 1.0);
  if (!(clip.w > 0.0) || clip.z < 0.0 || clip.z > clip.w || std::abs(clip.x) > clip.w || std::abs(clip.y) > clip.w)
    return std::nullopt;
  const double x = (0.5 + 0.5 * clip.x / clip.w) * view.width;
  const double y = (0.5 - 0.5 * clip.y / clip.w) * view.height;
  const auto inside = [](double v, double size) {
    const double in_tile = std::fmod(v, GLOAM_LIGHT_TILE);
    return v > 0.01 && v < size - 0.01 && in_tile > 0.01 && in_tile < GLOAM_LIGHT_TILE - 0.01;
  };
  if (!inside(x, view.width) || !inside(y, view.height)) return std::nullopt;
  return uvec2(static_cast<std::uint32_t>(x) / GLOAM_LIGHT_TILE, static_cast<std::uint32_t>(y) / GLOAM_LIGHT_TILE);
}

[[nodiscard]] inline bool has_light(const TileLightMasks& masks, uvec2 tile, std::uint32_t light) {
  const std::uint32_t* words = &masks.words[std::size_t{tile.y * masks.tiles.x + tile.x} * GLOAM_MASK_WORDS];
  return (words[0] >> (light / 32) & 1u) != 0 && (words[1 + light / 32] >> (light % 32) & 1u) != 0;
}

/// The words, with undefined ones set to 0.
[[nodiscard]] inline std::vector<std::uint32_t> meant_words(const TileLightMasks& masks) {
  std::vector<std::uint32_t> words = masks.words;
  for (std::size_t tile = 0; tile + GLOAM_MASK_WORDS <= words.size(); tile += GLOAM_MASK_WORDS)
    for (std::size_t group = 0; group < GLOAM_LIGHT_GROUPS; ++group)
      if ((words[tile] >> group & 1u) == 0) words[tile + 1 + group] = 0;
  return words;
}

/// Passes points of a light's volume to the visitor, including points of its outline as the camera sees it.
template <class Visit>
void sample_light(const MaskLight& light, const RenderView& view, SceneRandom& random, int count, Visit&& visit) {
  const bool spot = light.cos_outer > -1.0f;
  const dvec3 center(light.bounds.center);
  const double radius = light.bounds.radius;
  const Cone cone{light.apex, light.direction,
                  static_cast<float>(std::acos(std::clamp(static_cast<double>(light.cos_outer), 0.0, 1.0))),
                  light.range_m};
  const SupportPoint support = spot ? support_of(cone) : support_of(light.bounds);
  visit(spot ? dvec3(light.apex) : center);
  for (int i = 0; i < count; ++i) visit(support(random.direction()));
  const double distance = glm::length(center);
  const dvec3 forward = -dvec3(glm::transpose(dmat4(view.view_from_relative))[2]);
  const dvec3 axis = view.camera.orthographic ? forward : distance > 0.0 ? center / distance : forward;
  const dvec3 side = any_across(axis);
  const dvec3 up = glm::cross(axis, side);
  for (int i = 0; i < count; ++i) {
    const double turn = 2.0 * 3.14159265358979323846 * (i + random.between(0.0, 1.0)) / count;
    dvec3 outward = std::cos(turn) * side + std::sin(turn) * up;
    // Outline of the bounding sphere: where rays from the camera touch it.
    if (!view.camera.orthographic && distance > radius)
      outward = outward * std::sqrt(1.0 - radius / distance * (radius / distance)) - axis * (radius / distance);
    visit(support(outward));
  }
  if (!spot) return;
  const dvec3 shine = glm::normalize(dvec3(light.direction));
  const dvec3 across = any_across(shine);
  for (int i = 0; i < count; ++i) {
    const double turn = random.between(0.0, 6.2831853);
    const double angle = static_cast<double>(cone.half_angle) * (random.one_in(2) ? 1.0 : random.between(0.0, 1.0));
    const dvec3 rim = std::cos(turn) * across + std::sin(turn) * glm::cross(shine, across);
    visit(dvec3(light.apex) +
          (light.range_m * random.between(0.0, 1.0)) * (std::cos(angle) * shine + std::sin(angle) * rim));
  }
}

/// An error text for the first point of a light that the masks miss, or empty. `count`: a third of the number of
/// points.
[[nodiscard]] inline std::string missed_tile(const TileLightMasks& masks, const MaskLight& light, std::uint32_t index,
                                             const RenderView& view, SceneRandom& random, int count) {
  std::string missed;
  const auto look = [&](const dvec3& point) {
    const auto tile = tile_of(view, point);
    if (!tile || has_light(masks, *tile, index) || !missed.empty()) return;
    std::ostringstream text;
    text << std::setprecision(9) << "light " << index << " at " << light.apex.x << ' ' << light.apex.y << ' '
         << light.apex.z << ", range " << light.range_m << ", cosine " << light.cos_outer << ", towards "
         << light.direction.x << ' ' << light.direction.y << ' ' << light.direction.z << ", is missing in tile "
         << tile->x << ',' << tile->y << " of " << view.width << 'x' << view.height
         << (view.camera.orthographic ? " orthographic" : "") << ", near " << view.near_m << ", for " << point.x << ' '
         << point.y << ' ' << point.z;
    missed = text.str();
  };
  const dmat4 clip(view.clip_from_relative);
  const auto before_near = [&](const dvec3& p) {
    const dvec4 c = clip * dvec4(p, 1.0);
    return c.w - c.z;  // linear in p, 0 at the near plane
  };
  dvec3 last(light.apex);
  sample_light(light, view, random, count, [&](const dvec3& point) {
    look(point);
    look(glm::mix(point, last, random.between(0.0, 1.0)));  // the volume is convex
    const double a = before_near(last);
    const double b = before_near(point);
    if ((a < 0.0) != (b < 0.0)) {
      const double at = a / (a - b);
      look(glm::mix(last, point, std::clamp(at + (b > a ? 1e-7 : -1e-7), 0.0, 1.0)));
    }
    last = point;
  });
  return missed;
}

/// Whether a sphere beyond the near plane is visible within a tile widened by `margin` pixels. In double, by the angle
/// between rays (orthographic: by distance).
[[nodiscard]] inline bool touches_tile(const Sphere& sphere, const RenderView& view, uvec2 tile, double margin) {
  const dmat4 view_from_clip = glm::inverse(dmat4(view.clip_from_view));
  const dvec3 center = dvec3(dmat4(view.view_from_relative) * dvec4(dvec3(sphere.center), 1.0));
  const auto on_near = [&](double x, double y) {
    const double right = (tile.x + 1.0) * GLOAM_LIGHT_TILE + margin;  // may be outside the picture
    const double bottom = (tile.y + 1.0) * GLOAM_LIGHT_TILE + margin;
    const double px = glm::mix(tile.x * double{GLOAM_LIGHT_TILE} - margin, right, x);
    const double py = glm::mix(tile.y * double{GLOAM_LIGHT_TILE} - margin, bottom, y);
    const dvec4 p = view_from_clip * dvec4(2.0 * px / view.width - 1.0, 1.0 - 2.0 * py / view.height, 1.0, 1.0);
    return dvec3(p) / p.w;
  };
  // Distance of a point of the near plane from the centre of the sphere's image: an angle between rays, or metres.
  const auto away = [&](const dvec3& p) {
    if (view.camera.orthographic) return std::hypot(p.x - center.x, p.y - center.y);
    return std::atan2(glm::length(glm::cross(p, center)), glm::dot(p, center));
  };
  const double reach = view.camera.orthographic
                           ? static_cast<double>(sphere.radius)
                           : std::asin(std::min(1.0, static_cast<double>(sphere.radius) / glm::length(center)));
  const auto least = [&](auto&& along) {
    double low = 0.0;
    double high = 1.0;
    for (int i = 0; i < 60; ++i) {
      const double a = low + (high - low) / 3.0;
      const double b = high - (high - low) / 3.0;
      (away(along(a)) < away(along(b)) ? high : low) = away(along(a)) < away(along(b)) ? b : a;
    }
    return away(along(0.5 * (low + high)));
  };
  double nearest =
      std::min({least([&](double t) { return on_near(t, 0.0); }), least([&](double t) { return on_near(t, 1.0); }),
                least([&](double t) { return on_near(0.0, t); }), least([&](double t) { return on_near(1.0, t); })});
  const dvec4 c = dmat4(view.clip_from_view) * dvec4(center, 1.0);
  const double x = (0.5 + 0.5 * c.x / c.w) * view.width;
  const double y = (0.5 - 0.5 * c.y / c.w) * view.height;
  const bool within = x >= tile.x * double{GLOAM_LIGHT_TILE} && x <= (tile.x + 1.0) * GLOAM_LIGHT_TILE &&
                      y >= tile.y * double{GLOAM_LIGHT_TILE} && y <= (tile.y + 1.0) * GLOAM_LIGHT_TILE;
  if (within) nearest = 0.0;
  return nearest <= reach * (1.0 + 1e-6);
}

}  // namespace gloam::test

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/ext/matrix_transform.hpp>
#include <limits>
#include <optional>
#include <random>
#include <vector>

#include "engine/jobs/executor.h"
#include "engine/render/view.h"
#include "modules/reflections/culling/tiles.h"

/// Brute-force oracle of proxy tiles, in double: it mirrors the view ray of a pixel at its receiver and intersects all
/// proxies.
namespace gloam::test {

using glm::dvec2;

class ProxyRandom {
 public:
  explicit ProxyRandom(std::uint32_t seed) : engine_(seed) {}
  double between(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine_()) / 4294967296.0);
  }
  double length(double low, double high) { return std::pow(10.0, between(low, high)); }  ///< 10^low…10^high metres
  int index(int count) { return static_cast<int>(engine_() % static_cast<std::uint32_t>(count)); }
  bool one_in(int count) { return index(count) == 0; }
  dvec3 inside(const dvec3& half) {
    const double x = between(-half.x, half.x);
    const double y = between(-half.y, half.y);
    return {x, y, between(-half.z, half.z)};
  }
  dvec3 direction() {
    for (;;) {
      const dvec3 v = inside(dvec3(1.0));
      if (const double l = glm::length(v); l > 0.01 && l < 1.0) return v / l;
    }
  }

 private:
  std::mt19937 engine_;
};

struct SceneProxy {
  IbrProxy proxy;
  dmat4 world_from_node = dmat4(1.0);
  [[nodiscard]] dvec3 point(double u, double v) const {  // u, v: −0.5…0.5
    return dvec3(world_from_node *
                 dvec4(u * static_cast<double>(proxy.size_m.x), v * static_cast<double>(proxy.size_m.y), 0.0, 1.0));
  }
};
struct SceneRoom {
  IbrRoom room;
  dmat4 world_from_node = dmat4(1.0);
  std::optional<ReflectingHeights> heights;
  [[nodiscard]] bool contains(const dvec3& p) const {
    const dvec3 local = dvec3(glm::inverse(world_from_node) * dvec4(p, 1.0));
    return std::abs(local.x) * 2.0 <= static_cast<double>(room.size_m.x) &&
           std::abs(local.y) * 2.0 <= static_cast<double>(room.size_m.y) &&
           std::abs(local.z) * 2.0 <= static_cast<double>(room.size_m.z);
  }
  [[nodiscard]] double floor() const {
    double lowest = std::numeric_limits<double>::infinity();
    for (int corner = 0; corner < 8; ++corner) {
      const vec3 half = room.size_m * 0.5f;
      const dvec3 local((corner & 1) != 0 ? half.x : -half.x, (corner & 2) != 0 ? half.y : -half.y,
                        (corner & 4) != 0 ? half.z : -half.z);
      lowest = std::min(lowest, (world_from_node * dvec4(local, 1.0)).y);
    }
    return lowest;
  }
};

struct ProxyScene {
  std::vector<SceneProxy> proxies;
  std::vector<SceneRoom> rooms;

  SceneProxy& add(const dvec3& center, const dvec3& toward, vec2 size) {
    const dvec3 up = std::abs(glm::normalize(toward).y) > 0.99 ? dvec3(1.0, 0.0, 0.0) : dvec3(0.0, 1.0, 0.0);
    SceneProxy& added = proxies.emplace_back();
    added.proxy.size_m = size;
    added.world_from_node = glm::inverse(glm::lookAt(center, center - toward, up));  // +Z along `toward`
    return added;
  }
  SceneRoom& add_room(const dvec3& center, vec3 size) {
    SceneRoom& added = rooms.emplace_back();
    added.room.size_m = size;
    added.world_from_node = glm::translate(dmat4(1.0), center);
    return added;
  }
  /// All proxies must have an area and finite matrices, so that indices agree.
  [[nodiscard]] ProxySet placed() const {
    ProxySet set;
    for (const SceneProxy& p : proxies) {
      PlacedProxy placed;
      if (place_proxy({static_cast<std::uint32_t>(set.proxies.size()), 1}, p.proxy, p.world_from_node, placed) ==
          ProxyPlacement::placed)
        set.proxies.push_back(placed);
    }
    for (const SceneRoom& r : rooms) {
      PlacedRoom placed;
      if (place_room(kNoEntity, r.room, r.heights ? &*r.heights : nullptr, r.world_from_node, placed))
        set.rooms.push_back(placed);
    }
    return set;
  }

  /// Whether the rules of rooms let a receiver at this height show proxy i.
  [[nodiscard]] bool allows(std::size_t i, const dvec3& camera, double height) const {
    const dvec3 center(proxies[i].world_from_node[3]);
    bool camera_in_room = false;
    bool proxy_in_room = false;
    bool allowed = false;
    for (const SceneRoom& room : rooms) {
      const bool camera_inside = room.contains(camera);
      const bool proxy_inside = room.contains(center);
      camera_in_room |= camera_inside;
      proxy_in_room |= proxy_inside;
      if (!camera_inside || !proxy_inside) continue;
      if (!room.heights || room.heights->count == 0) {
        allowed |= height >= room.floor();
        continue;
      }
      for (std::uint32_t h = 0; h < room.heights->count; ++h)
        allowed |= std::abs(height - static_cast<double>(room.heights->heights_m[h])) < 1e-6;
    }
    return camera_in_room ? allowed : !proxy_in_room;
  }
};

/// The view ray of a pixel, relative to the camera.
struct PixelRay {
  dvec3 origin = dvec3(0.0);
  dvec3 direction = dvec3(0.0);  ///< one metre of view depth
};
inline PixelRay pixel_ray(const RenderView& view, const dvec2& ndc) {
  const dmat4 rotation = glm::transpose(dmat4(view.view_from_relative));
  const dmat4 clip(view.clip_from_view);
  if (view.camera.orthographic) {
    const dvec4 start((ndc.x - clip[3][0]) / clip[0][0], (ndc.y - clip[3][1]) / clip[1][1], 0.0, 0.0);
    return {dvec3(rotation * start), dvec3(rotation * dvec4(0.0, 0.0, -1.0, 0.0))};
  }
  // x_ndc · d = c00 · x − c20 · d at view depth d.
  const dvec4 at_one((ndc.x + clip[2][0]) / clip[0][0], (ndc.y + clip[2][1]) / clip[1][1], -1.0, 0.0);
  return {dvec3(0.0), dvec3(rotation * at_one)};
}

/// NDC of a camera-relative position with positive depth.
inline dvec2 ndc_of(const RenderView& view, const dvec3& relative) {
  const dvec4 clip = dmat4(view.clip_from_view) * dmat4(view.view_from_relative) * dvec4(relative, 1.0);
  return dvec2(clip.x, clip.y) / clip.w;
}

/// Whether the ray from the receiver (camera-relative), an up normal's mirror image of `direction`, hits the front of
/// the proxy.
inline bool reflected_ray_hits(const SceneProxy& proxy, const dvec3& eye, const dvec3& receiver,
                               const dvec3& direction) {
  const dvec3 ray(direction.x, -direction.y, direction.z);
  const dvec3 corner = proxy.point(-0.5, -0.5) - eye;
  const dvec3 u = proxy.point(0.5, -0.5) - eye - corner;
  const dvec3 v = proxy.point(-0.5, 0.5) - eye - corner;
  const dvec3 across = glm::cross(u, v);
  const double facing = glm::dot(across, dvec3(proxy.world_from_node[2])) < 0.0 ? -1.0 : 1.0;
  const double along = glm::dot(across, ray);
  if (!(along * facing < 0.0)) return false;
  const double t = glm::dot(across, corner - receiver) / along;
  if (!(t > 0.0)) return false;
  const dvec3 hit = receiver + ray * t - corner;
  const double area2 = glm::dot(across, across);
  const double s = glm::dot(glm::cross(hit, v), across) / area2;
  const double r = glm::dot(glm::cross(u, hit), across) / area2;
  return s >= 0.0 && s <= 1.0 && r >= 0.0 && r <= 1.0;
}

/// A pixel and its receiver.
struct PixelReceiver {
  dvec2 ndc;
  dvec3 direction;  ///< of the view ray
  dvec3 position;   ///< camera-relative
};

/// The receiver where the ray of the pixel descends to a height relative to the camera; none if it does not, or nearer
/// than the near plane, or if the pixel is off the screen.
inline std::optional<PixelReceiver> receiver_at(const RenderView& view, const dvec2& ndc, double height) {
  if (!(std::abs(ndc.x) < 1.0 && std::abs(ndc.y) < 1.0)) return std::nullopt;
  const PixelRay ray = pixel_ray(view, ndc);
  if (!(ray.direction.y < 0.0)) return std::nullopt;
  const double depth = (height - ray.origin.y) / ray.direction.y;
  if (!(depth >= static_cast<double>(view.near_m))) return std::nullopt;
  return PixelReceiver{ndc, ray.direction, ray.origin + ray.direction * depth};
}

/// The pixel and receiver at this height (relative to the camera) that show the point (camera-relative), if any.
inline std::optional<PixelReceiver> receiver_that_shows(const RenderView& view, const dvec3& point, double height) {
  const dvec3 image(point.x, 2.0 * height - point.y, point.z);
  const dmat4 to_view(view.view_from_relative);
  if (!(-(to_view * dvec4(image, 1.0)).z > 0.0)) return std::nullopt;
  return receiver_at(view, ndc_of(view, image), height);
}

inline std::uint32_t column_of(double ndc_x, std::uint32_t columns) {
  const double column = std::floor((ndc_x + 1.0) * 0.5 * static_cast<double>(columns));
  return static_cast<std::uint32_t>(std::clamp(column, 0.0, static_cast<double>(columns) - 1.0));
}

/// Whether proxy i of the set is in the mask of the pixel's tile.
inline bool tile_has(const ProxyTiles& tiles, double ndc_x, std::size_t i) {
  const auto found = std::ranges::lower_bound(tiles.proxies, i);
  if (found == tiles.proxies.end() || *found != i) return false;
  const std::uint32_t tile = proxy_tile_of(column_of(ndc_x, tiles.columns), tiles.columns, tiles.tiles);
  return tiles.may_reflect(tile, static_cast<std::uint32_t>(found - tiles.proxies.begin()));
}

inline ProxyTiles build(const ProxyScene& scene, const RenderView& view, const ProxyTileSettings& settings = {}) {
  ProxyTiles tiles;
  build_proxy_tiles(scene.placed(), view, settings, *make_serial_executor(), tiles);
  return tiles;
}

/// Hits that the brute force found, and those whose tile does not list the proxy.
struct HitCount {
  std::uint64_t hits = 0;
  std::uint64_t missed = 0;
};

inline void count_hits(const ProxyScene& scene, const RenderView& view, const ProxyTiles& tiles,
                       const PixelReceiver& pixel, HitCount& count) {
  for (std::size_t i = 0; i < scene.proxies.size(); ++i) {
    if (!reflected_ray_hits(scene.proxies[i], view.position, pixel.position, pixel.direction)) continue;
    if (!scene.allows(i, view.position, pixel.position.y + view.position.y)) continue;
    ++count.hits;
    if (!tile_has(tiles, pixel.ndc.x, i)) ++count.missed;
  }
}

/// Tries `tries` random pixels at random heights, and as many that show a random point of a random proxy. heights: the
/// heights to draw from; empty: from `lowest` to the top of everything.
inline void try_pixels(const ProxyScene& scene, const RenderView& view, const ProxyTiles& tiles, int tries,
                       double lowest, const std::vector<double>& heights, ProxyRandom& random, HitCount& count) {
  if (scene.proxies.empty()) return;
  const double camera_y = view.position.y;
  for (int n = 0; n < 2 * tries; ++n) {
    const SceneProxy& proxy =
        scene.proxies[static_cast<std::size_t>(random.index(static_cast<int>(scene.proxies.size())))];
    const dvec3 point = proxy.point(random.between(-0.5, 0.5), random.between(-0.5, 0.5));
    const double top = std::min(std::max(lowest, point.y), std::max(lowest, camera_y));
    double height = random.one_in(4) ? lowest : random.between(lowest, view.camera.orthographic ? point.y : top);
    if (!heights.empty()) height = heights[static_cast<std::size_t>(random.index(static_cast<int>(heights.size())))];
    const auto pixel =
        n % 2 == 0 ? receiver_at(view, {random.between(-1.0, 1.0), random.between(-1.0, 1.0)}, height - camera_y)
                   : receiver_that_shows(view, point - view.position, height - camera_y);
    if (pixel) count_hits(scene, view, tiles, *pixel, count);
  }
}

/// A view of 320×180 pixels. pitch: radians, down is negative.
inline RenderView view_from(const dvec3& eye, double yaw, double pitch, double roll = 0.0, float near_m = 0.1f,
                            bool orthographic = false) {
  ViewSettings settings;
  settings.width = 320;
  settings.height = 180;
  settings.camera.near_m = near_m;
  settings.camera.fov_y = 1.0f;
  settings.camera.orthographic = orthographic;
  settings.camera.half_height_m = 4.0f;
  dmat4 pose = glm::translate(dmat4(1.0), eye);
  pose = glm::rotate(pose, yaw, dvec3(0.0, 1.0, 0.0));
  pose = glm::rotate(pose, pitch, dvec3(1.0, 0.0, 0.0));
  settings.world_from_camera = glm::rotate(pose, roll, dvec3(0.0, 0.0, 1.0));
  return make_view(settings, 0);
}

}  // namespace gloam::test

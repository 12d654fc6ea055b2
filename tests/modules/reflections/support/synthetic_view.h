// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "engine/math/packing.h"
#include "engine/render/camera/view_constants.h"
#include "engine/render/view.h"
#include "shaders/reflections/reflections_shared.h"
#include "tests/modules/reflections/culling/proxy_oracle.h"

/// Geometry buffers of small scenes, traced in double at pixel centres, for kernels of reflections.
namespace gloam::test {

/// An axis-aligned box, world metres.
struct SyntheticBox {
  dvec3 low = dvec3(0.0);
  dvec3 high = dvec3(0.0);
  std::uint32_t material = 0x00FF0080u;  ///< bytes: roughness, metallic, occlusion, reflectivity
};

/// A reflecting floor at a height, and boxes.
struct SyntheticScene {
  double floor_m = 0.0;
  std::vector<SyntheticBox> boxes;
  std::uint32_t floor_material = 0xFFFF0000u;  ///< bytes: roughness, metallic, occlusion, reflectivity
};

/// The images that reflection kernels read of a view's surfaces, rows from the top.
struct SyntheticView {
  RenderView view;
  std::vector<float> depth;  ///< reversed Z
  std::vector<uvec2> normals;
  std::vector<std::uint32_t> material;
  std::vector<int> object;  ///< −1: sky, 0: floor, 1 + i: box i

  [[nodiscard]] std::size_t at(std::uint32_t x, std::uint32_t y) const { return std::size_t{y} * view.width + x; }
  [[nodiscard]] double view_depth(std::size_t pixel) const {
    const dmat4 m(view.clip_from_view);
    const auto z = static_cast<double>(depth[pixel]);
    return (m[3][2] - z * m[3][3]) / (m[2][2] - z * m[2][3]);
  }
  [[nodiscard]] PixelRay ray(std::uint32_t x, std::uint32_t y) const {
    return pixel_ray(view, {2.0 * (x + 0.5) / view.width - 1.0, 1.0 - 2.0 * (y + 0.5) / view.height});
  }
  /// Camera-relative.
  [[nodiscard]] dvec3 position(std::uint32_t x, std::uint32_t y) const {
    const PixelRay r = ray(x, y);
    return r.origin + r.direction * view_depth(at(x, y));
  }
  [[nodiscard]] dvec3 mirrored(std::uint32_t x, std::uint32_t y) const {
    return glm::normalize(ray(x, y).direction) * dvec3(1.0, -1.0, 1.0);
  }
  void set(std::size_t pixel, double metres, const dvec3& normal, std::uint32_t bytes, int what) {
    const dmat4 m(view.clip_from_view);
    depth[pixel] = static_cast<float>((m[3][2] - metres * m[2][2]) / (m[3][3] - metres * m[2][3]));
    const std::uint32_t packed = pack_normal_snorm16(vec3(normal));
    normals[pixel] = {packed, packed};
    material[pixel] = bytes;
    object[pixel] = what;
  }
  /// Farthest and nearest depth of each tile of 8×8 pixels, sky excluded.
  [[nodiscard]] std::vector<vec2> depth_bounds() const {
    const std::uint32_t wide = (view.width + 7) / 8, high = (view.height + 7) / 8;
    std::vector<vec2> bounds(std::size_t{wide} * high, vec2(1.0f, 0.0f));
    for (std::uint32_t y = 0; y < view.height; ++y)
      for (std::uint32_t x = 0; x < view.width; ++x) {
        vec2& tile = bounds[std::size_t{y / 8} * wide + x / 8];
        const float z = depth[at(x, y)];
        if (z > 0.0f) tile = {std::min(tile.x, z), std::max(tile.y, z)};
      }
    return bounds;
  }
};

[[nodiscard]] inline SyntheticView empty_view(const ViewSettings& settings) {
  SyntheticView seen;
  seen.view = make_view(settings, 0);
  const std::size_t pixels = std::size_t{settings.width} * settings.height;
  seen.depth.assign(pixels, 0.0f);
  seen.normals.assign(pixels, uvec2(0u));
  seen.material.assign(pixels, 0u);
  seen.object.assign(pixels, -1);
  return seen;
}

/// The first point of a box that a ray meets from outside; the distance is infinite if there is none.
struct BoxMeeting {
  double along = std::numeric_limits<double>::infinity();
  dvec3 normal = dvec3(0.0);
};
[[nodiscard]] inline BoxMeeting meet_box(const SyntheticBox& box, const dvec3& origin, const dvec3& direction) {
  double enter = 0.0, leave = std::numeric_limits<double>::infinity();
  int axis = -1;
  for (int i = 0; i < 3; ++i) {
    const double a = (box.low[i] - origin[i]) / direction[i], b = (box.high[i] - origin[i]) / direction[i];
    if (direction[i] == 0.0) {
      if (origin[i] < box.low[i] || origin[i] > box.high[i]) return {};
      continue;
    }
    if (std::min(a, b) > enter) enter = std::min(a, b), axis = i;
    leave = std::min(leave, std::max(a, b));
  }
  if (axis < 0 || enter > leave) return {};
  BoxMeeting met{enter, dvec3(0.0)};
  met.normal[axis] = direction[axis] > 0.0 ? -1.0 : 1.0;
  return met;
}

[[nodiscard]] inline SyntheticView look(const SyntheticScene& scene, const ViewSettings& settings) {
  SyntheticView seen = empty_view(settings);
  for (std::uint32_t y = 0; y < settings.height; ++y)
    for (std::uint32_t x = 0; x < settings.width; ++x) {
      const PixelRay ray = seen.ray(x, y);
      const dvec3 origin = ray.origin + seen.view.position;
      const double floor = (scene.floor_m - origin.y) / ray.direction.y, near_m = seen.view.near_m;
      double nearest = std::numeric_limits<double>::infinity();
      if (ray.direction.y < 0.0 && floor > near_m) {
        nearest = floor;
        seen.set(seen.at(x, y), floor, dvec3(0.0, 1.0, 0.0), scene.floor_material, 0);
      }
      for (std::size_t i = 0; i < scene.boxes.size(); ++i) {
        const BoxMeeting met = meet_box(scene.boxes[i], origin, ray.direction);
        if (!(met.along < nearest) || met.along < near_m) continue;
        nearest = met.along;
        seen.set(seen.at(x, y), met.along, met.normal, scene.boxes[i].material, static_cast<int>(i) + 1);
      }
    }
  return seen;
}

/// Constants as the module sets them, without fog and changed lights.
[[nodiscard]] inline shaders::ReflectionConstants reflection_constants(const RenderView& view, std::uint32_t scale) {
  shaders::ReflectionConstants c{};
  c.unit_m = 1.0f;
  c.scale = scale;
  c.size = (uvec2(view.width, view.height) + scale - 1u) / scale;
  c.k1 = 32.0f;
  c.k2 = 0.02f;
  c.refine = 5;
  c.reach_m = 2.0f;
  c.thickness_m = 0.35f;
  c.blur_scale = 1.0f;
  c.blur_across = 0.1f;
  c.blur_tail = 2.5f;
  c.blur_tail_share = 0.5f;
  c.pixel_roughness = 1;
  c.blur_radius = 8;
  c.capture_scale = 1.0f;
  return c;
}

/// Whether mirrored images serve the surface at a pixel: smooth, reflective, about horizontal, seen from above.
[[nodiscard]] inline bool is_mirror(const SyntheticView& seen, uvec2 pixel) {
  const std::size_t at = seen.at(pixel.x, pixel.y);
  const std::uint32_t bytes = seen.material[at];
  return (bytes >> 24) > 0 && (bytes & 0xFFu) < 125 && seen.object[at] >= 0 &&
         unpack_normal_snorm16(seen.normals[at].y).y > 0.866f && seen.mirrored(pixel.x, pixel.y).y > 1e-4;
}

/// The pixel whose surface a texel of the reflection images stands for: of its 2×2 block the first that mirrors, from
/// the candidate on; the first one if none does.
[[nodiscard]] inline uvec2 surface_pixel(const SyntheticView& seen, std::uint32_t scale, uvec2 texel,
                                         std::uint32_t candidate = 0) {
  if (scale == 1) return texel;
  for (std::uint32_t k = 0; k < 4; ++k) {
    const std::uint32_t i = (candidate + k) % 4;
    const uvec2 pixel = texel * 2u + uvec2(i & 1u, i >> 1);
    if (pixel.x < seen.view.width && pixel.y < seen.view.height && is_mirror(seen, pixel)) return pixel;
  }
  return texel * 2u;
}

}  // namespace gloam::test

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "tests/modules/lights/lists/find_lights_scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <limits>

namespace gloam::test {
namespace {

using glm::dvec2;

constexpr std::uint32_t kMaskTile = GLOAM_LIGHT_TILE;

std::uint32_t divided_up(std::uint32_t value, std::uint32_t by) { return (value + by - 1) / by; }

double view_depth(const SearchedScene& scene, const dvec3& relative) {
  return -(dmat4(scene.view.view_from_relative) * dvec4(relative, 0.0)).z;
}

shaders::LocalLight packed(const TestLight& light) {
  shaders::LocalLight p{};
  p.position = vec3(light.position);
  p.inverse_range_squared = static_cast<float>(1.0 / (light.range_m * light.range_m));
  p.color = vec3(static_cast<float>(light.intensity));
  p.direction = vec3(glm::normalize(light.direction));
  p.spot_offset = 1.0f;
  if (light.outer_angle >= 0.0) {
    const double cos_outer = std::cos(std::min(light.outer_angle, kHalfPiRadians));
    p.spot_scale = static_cast<float>(1.0 / std::max(1e-3, std::cos(light.inner_angle) - cos_outer));
    p.spot_offset = static_cast<float>(-cos_outer) * p.spot_scale;
  }
  return p;
}

struct Interval {
  double nearest, farthest;
};

/// View depths of a light's range, computed from the numbers that the GPU reads.
Interval depths_of(const SearchedScene& scene, const shaders::LocalLight& light) {
  const double depth = view_depth(scene, dvec3(light.position));
  const double range = 1.00002 / std::sqrt(static_cast<double>(light.inverse_range_squared));
  return {std::max(depth - range, static_cast<double>(scene.view.near_m)), depth + range};
}

void build_bounds(SearchedScene& scene) {
  scene.bounds.assign(scene.tile_count(), vec2(1.0f, 0.0f));
  for (std::uint32_t tile = 0; tile < scene.tile_count(); ++tile) {
    vec2& found = scene.bounds[tile];
    scene.for_pixels(scene.tile_at(tile), [&](std::uint32_t, std::uint32_t, float d) {
      if (d > 0.0f) found = vec2(std::min(found.x, d), std::max(found.y, d));
    });
  }
}

/// The farthest surface, which bounds the zBins.
double farthest_surface(const SearchedScene& scene) {
  float least = 1.0f;
  for (const float d : scene.depth)
    if (d > 0.0f) least = std::min(least, d);
  const double far_m = view_depth(scene, scene.position_at(0.0, 0.0, static_cast<double>(least)));
  return std::max(far_m, static_cast<double>(scene.view.near_m) * 1.5);
}

void build_z_bins(SearchedScene& scene, std::uint32_t count) {
  const double near_m = static_cast<double>(scene.view.near_m);
  const double bin_m = (farthest_surface(scene) - near_m) / count;
  scene.grid.z_bin_count = count;
  scene.grid.z_near = scene.view.near_m;
  scene.grid.z_scale = static_cast<float>(1.0 / bin_m);
  std::vector<std::uint32_t> begin(count, 0xFFFF), end(count, 0);
  for (std::uint32_t bin = 0; bin < count; ++bin) {
    const double low = near_m + bin_m * bin;
    const double high = bin + 1 == count ? std::numeric_limits<double>::infinity() : low + bin_m;
    const double slack = 2e-5 * (low + bin_m) + 1e-5;
    for (std::uint32_t i = 0; i < scene.lights->local_count; ++i) {
      const Interval depths = depths_of(scene, scene.lights->local[i]);
      if (depths.nearest > high + slack || depths.farthest < low - slack) continue;
      begin[bin] = std::min(begin[bin], i);
      end[bin] = std::max(end[bin], i + 1);
    }
  }
  scene.z_bins.clear();
  for (std::uint32_t bin = 0; bin < count; ++bin) scene.z_bins.push_back(begin[bin] | end[bin] << 16);
  for (std::uint32_t bin = 0; bin < count; ++bin)
    scene.z_bins.push_back(*std::min_element(begin.begin() + bin, begin.end()) |
                           *std::max_element(end.begin(), end.begin() + bin + 1) << 16);
}

/// Unit normal and offset of a plane; distance = dot(normal, p) + offset.
struct Plane {
  dvec3 normal;
  double offset;
};

/// The four side planes of a pixel rectangle's beam, pointing outward.
std::array<Plane, 4> beam_of(const SearchedScene& scene, uvec2 first, uvec2 last) {
  const dvec2 corners[] = {dvec2(first), dvec2(last.x, first.y), dvec2(last), dvec2(first.x, last.y)};
  const dvec3 inside = scene.position_at(0.5 * (first.x + last.x), 0.5 * (first.y + last.y), 0.5);
  std::array<Plane, 4> planes{};
  for (std::size_t i = 0; i < 4; ++i) {
    const dvec2 a = corners[i], b = corners[(i + 1) % 4];
    const dvec3 p = scene.position_at(a.x, a.y, 0.5);
    dvec3 normal =
        glm::normalize(glm::cross(scene.position_at(a.x, a.y, 0.25) - p, scene.position_at(b.x, b.y, 0.5) - p));
    if (glm::dot(normal, inside - p) > 0.0) normal = -normal;
    planes[i] = {normal, -glm::dot(normal, p)};
  }
  return planes;
}

void build_mask_tiles(SearchedScene& scene) {
  const uvec2 tiles = scene.grid.mask_tiles;
  scene.mask_tiles.assign(std::size_t{tiles.x} * tiles.y * GLOAM_MASK_WORDS, 0);
  for (std::uint32_t tile = 0; tile < tiles.x * tiles.y; ++tile) {
    const uvec2 first = uvec2(tile % tiles.x, tile / tiles.x) * kMaskTile;
    const auto beam = beam_of(scene, first, glm::min(first + kMaskTile, scene.size()));
    std::uint32_t* words = &scene.mask_tiles[std::size_t{tile} * GLOAM_MASK_WORDS];
    for (std::uint32_t i = 0; i < scene.lights->local_count; ++i) {
      const dvec3 center(scene.lights->local[i].position);
      const double reach = 1.0001 / std::sqrt(static_cast<double>(scene.lights->local[i].inverse_range_squared)) +
                           1e-5 * glm::length(center) + 1e-5;
      if (std::any_of(beam.begin(), beam.end(),
                      [&](const Plane& p) { return glm::dot(p.normal, center) + p.offset > reach; }))
        continue;
      words[0] |= 1u << i / 32;
      words[1 + i / 32] |= 1u << i % 32;
    }
    // A word whose group bit is 0 is undefined.
    for (std::uint32_t word = 0; word < GLOAM_LIGHT_GROUPS; ++word)
      if ((words[0] >> word & 1u) == 0) words[1 + word] = 0xDEADBEEFu;
  }
}

}  // namespace

dvec3 SearchedScene::position_at(double x, double y, double depth_value) const {
  const dvec4 p = relative_from_clip * dvec4(2.0 * x / view.width - 1.0, 1.0 - 2.0 * y / view.height, depth_value, 1.0);
  return dvec3(p) / p.w;
}

float SearchedScene::depth_of(double metres) const {
  const dvec4 p = dmat4(view.clip_from_view) * dvec4(0.0, 0.0, -metres, 1.0);
  return static_cast<float>(p.z / p.w);
}

SearchedScene empty_scene(const SceneSize& size) {
  ViewSettings settings;
  settings.width = size.width;
  settings.height = size.height;
  settings.camera.orthographic = size.orthographic;
  settings.camera.half_height_m = 8.0f;
  settings.camera.near_m = size.near_m;
  settings.world_from_camera =
      glm::rotate(glm::rotate(glm::translate(dmat4(1.0), size.origin), 0.7, glm::normalize(dvec3(0.3, 1.0, 0.2))),
                  size.roll, dvec3(0.0, 0.0, 1.0));
  SearchedScene scene;
  scene.view = make_view(settings, 0);
  scene.relative_from_clip = glm::inverse(dmat4(scene.view.clip_from_view) * dmat4(scene.view.view_from_relative));
  scene.depth.assign(std::size_t{size.width} * size.height, 0.0f);
  scene.grid.tiles = {divided_up(size.width, kTile), divided_up(size.height, kTile)};
  scene.grid.groups = {divided_up(scene.grid.tiles.x, GLOAM_TILE_GROUP),
                       divided_up(scene.grid.tiles.y, GLOAM_TILE_GROUP)};
  scene.grid.mask_tiles = {divided_up(size.width, kMaskTile), divided_up(size.height, kMaskTile)};
  return scene;
}

void draw_random_depth(SearchedScene& scene, std::mt19937& random, double nearest_m, double farthest_m) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (std::uint32_t tile = 0; tile < scene.tile_count(); ++tile) {
    const double near = nearest_m * std::pow(farthest_m / nearest_m, unit(random));
    const double far = near * (1.0 + (random() % 3 == 0 ? 4.0 : 0.1) * unit(random));
    const bool sky = random() % 6 == 0;
    const unsigned holes = random() % 4;
    scene.for_pixels(scene.tile_at(tile), [&](std::uint32_t x, std::uint32_t y, float) {
      const bool hole = sky || random() % 8 < holes;
      scene.depth[std::size_t{y} * scene.view.width + x] =
          hole ? 0.0f : scene.depth_of(near + (far - near) * unit(random));
    });
  }
}

std::vector<TestLight> random_lights(const SearchedScene& scene, std::uint32_t count, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  std::vector<TestLight> lights(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    TestLight& light = lights[i];
    const double metres = 0.5 * std::pow(100.0, 0.5 + 0.5 * unit(random));
    const dvec2 pixel = dvec2(scene.size()) * (dvec2(0.5) + 0.6 * dvec2(unit(random), unit(random)));
    light.position = scene.position_at(pixel.x, pixel.y, static_cast<double>(scene.depth_of(metres)));
    light.range_m = 0.05 * std::pow(100.0, 0.5 + 0.5 * unit(random)) * (1.0 + 0.1 * metres);
    light.direction = glm::normalize(dvec3(unit(random), unit(random), unit(random) + 1e-3));
    if (i % 2 == 1) {
      const double half_angle[] = {0.0, 0.01, 0.1, 0.4, 0.8, 1.0472, 1.2, kHalfPiRadians};
      light.outer_angle = half_angle[random() % 8];
      light.inner_angle = random() % 2 == 0 ? 0.0 : light.outer_angle;
    }
    if (i % 16 == 5) {
      const double away = std::pow(10.0, 2.0 + unit(random));
      light.position -= light.direction * away;
      light.range_m = away + 3.0;
      light.outer_angle = 0.5 / away + 0.002;
      light.inner_angle = 0.0;
    }
  }
  return lights;
}

void finish_scene(SearchedScene& scene, std::vector<TestLight> lights, const GridOptions& options) {
  build_bounds(scene);
  const auto depths = [&](const TestLight& light) { return depths_of(scene, packed(light)); };
  const double near_m = static_cast<double>(scene.view.near_m);
  std::erase_if(lights, [&](const TestLight& light) { return depths(light).farthest < near_m; });
  std::stable_sort(lights.begin(), lights.end(),
                   [&](const TestLight& a, const TestLight& b) { return depths(a).nearest < depths(b).nearest; });
  scene.lights->local_count = static_cast<std::uint32_t>(lights.size());
  for (std::size_t i = 0; i < lights.size(); ++i) scene.lights->local[i] = packed(lights[i]);
  scene.grid.local_count = scene.lights->local_count;
  scene.grid.slot_capacity = divided_up(options.slot_capacity, 3) * 3;
  scene.grid.fixed_slots = divided_up(options.fixed_slots, 3) * 3;
  build_z_bins(scene, options.z_bin_count);
  build_mask_tiles(scene);
}

SearchedScene random_scene(const SceneSize& size, std::uint32_t lights, std::uint32_t seed,
                           const GridOptions& options) {
  std::mt19937 random(seed);
  SearchedScene scene = empty_scene(size);
  draw_random_depth(scene, random);
  finish_scene(scene, random_lights(scene, lights, random), options);
  return scene;
}

Reach reach_of(const shaders::LocalLight& light, const dvec3& point) {
  const dvec3 offset = point - dvec3(light.position);
  const double distance = glm::length(offset);
  const double band_m = 4e-6 * (std::abs(point.x) + std::abs(point.y) + std::abs(point.z)) + 1e-6;
  const double range = 1.0 / std::sqrt(static_cast<double>(light.inverse_range_squared));
  double margin = (range * (1.0 - distance / range)) / (band_m + 4e-6 * range);
  if (light.spot_scale > 0.0f) {
    // Within 1 mm of the lamp, shading clamps the distance to 1 mm, so angles are unreliable.
    const double cosine = glm::dot(offset, dvec3(light.direction)) / std::max(distance, 1e-15);
    const double cos_outer = -static_cast<double>(light.spot_offset) / static_cast<double>(light.spot_scale);
    margin = std::min(margin, (cosine - cos_outer) / (3e-6 + 2.0 * band_m / std::max(distance, 1e-15)));
  }
  return margin > 1.0 ? Reach::certain : margin > -1.0 ? Reach::doubtful : Reach::none;
}

std::vector<Reach> reach_of_tile(const SearchedScene& scene, uvec2 tile) {
  std::vector<Reach> reach(scene.lights->local_count, Reach::none);
  scene.for_pixels(tile, [&](std::uint32_t x, std::uint32_t y, float depth) {
    if (depth <= 0.0f) return;
    const dvec3 point = scene.position_at(x + 0.5, y + 0.5, static_cast<double>(depth));
    for (std::size_t i = 0; i < reach.size(); ++i)
      if (reach[i] != Reach::certain) reach[i] = std::max(reach[i], reach_of(scene.lights->local[i], point));
  });
  return reach;
}

}  // namespace gloam::test

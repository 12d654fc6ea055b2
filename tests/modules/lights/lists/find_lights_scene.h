// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <random>
#include <vector>

#include "engine/render/view.h"
#include "shaders/lights/lights_shared.h"

/// Scenes for the kernels that find lights, and brute-force versions of their CPU inputs. Everything is in double
/// precision and written from the specification; it shares no code with the tested code.
namespace gloam::test {

constexpr std::uint32_t kTile = GLOAM_SHADOW_TILE;
constexpr double kHalfPiRadians = 1.57079632679489661923;

struct TestLight {
  dvec3 position = dvec3(0.0);  ///< camera-relative
  double range_m = 1.0;
  double intensity = 10.0;
  dvec3 direction = dvec3(0.0, 0.0, -1.0);
  double outer_angle = -1.0;  ///< half angle in radians; negative: a point light
  double inner_angle = 0.0;
};

/// A view, the depth of each of its pixels, its lights, and the zBins and tile masks.
struct SearchedScene {
  RenderView view;
  std::vector<float> depth;  ///< reversed Z, 0: sky
  std::unique_ptr<shaders::LightBlock> lights = std::make_unique<shaders::LightBlock>();
  shaders::LightGrid grid{};
  std::vector<vec2> bounds;               ///< per shadow tile: farthest and nearest depth; (1, 0) if it shows only sky
  std::vector<std::uint32_t> z_bins;      ///< standard set, then ranged set
  std::vector<std::uint32_t> mask_tiles;  ///< GLOAM_MASK_WORDS per tile of 32×32 pixels

  [[nodiscard]] std::uint32_t tile_count() const { return grid.tiles.x * grid.tiles.y; }
  [[nodiscard]] std::uint32_t group_count() const { return grid.groups.x * grid.groups.y; }
  [[nodiscard]] uvec2 tile_at(std::uint32_t index) const { return {index % grid.tiles.x, index / grid.tiles.x}; }
  [[nodiscard]] std::uint32_t group_of(uvec2 tile) const { return tile.y / 8 * grid.groups.x + tile.x / 8; }
  [[nodiscard]] bool is_sky(std::uint32_t tile) const { return bounds[tile].y <= 0.0f; }
  [[nodiscard]] uvec2 size() const { return {view.width, view.height}; }
  /// Camera-relative position of the surface with this depth value at a point of the picture, in pixels.
  [[nodiscard]] dvec3 position_at(double x, double y, double depth_value) const;
  /// Depth value of a surface at this distance in front of the camera.
  [[nodiscard]] float depth_of(double metres) const;
  template <class F>
  void for_pixels(uvec2 tile, F&& function) const {
    for (std::uint32_t y = tile.y * kTile; y < glm::min((tile.y + 1) * kTile, view.height); ++y)
      for (std::uint32_t x = tile.x * kTile; x < glm::min((tile.x + 1) * kTile, view.width); ++x)
        function(x, y, depth[std::size_t{y} * view.width + x]);
  }

  dmat4 relative_from_clip = dmat4(1.0);
};

struct SceneSize {
  std::uint32_t width = 64;
  std::uint32_t height = 64;
  bool orthographic = false;
  double roll = 0.0;
  float near_m = 0.1f;
  dvec3 origin = dvec3(0.0);  ///< world position of the camera
};
[[nodiscard]] SearchedScene empty_scene(const SceneSize& size);

/// Surfaces at many distances, edges inside tiles, holes to the sky, and tiles that show only sky.
void draw_random_depth(SearchedScene& scene, std::mt19937& random, double nearest_m = 0.3, double farthest_m = 60.0);

/// Points and spots of many sizes in front of the camera; some are far away, with a narrow cone that shines at the
/// scene.
[[nodiscard]] std::vector<TestLight> random_lights(const SearchedScene& scene, std::uint32_t count,
                                                   std::mt19937& random);

struct GridOptions {
  std::uint32_t z_bin_count = 256;
  std::uint32_t slot_capacity = 1u << 20;  ///< rounded up to a multiple of 3
  std::uint32_t fixed_slots = 0;
};

/// Sorts and packs the lights that are in front of the camera, and builds bounds, zBins and masks by brute force.
/// `lights`: at most GLOAM_MAX_LOCAL_LIGHTS.
void finish_scene(SearchedScene& scene, std::vector<TestLight> lights, const GridOptions& options = {});

[[nodiscard]] SearchedScene random_scene(const SceneSize& size, std::uint32_t lights, std::uint32_t seed,
                                         const GridOptions& options = {});

/// Whether a light reaches a point; doubtful: within the rounding of floats.
enum class Reach { none, doubtful, certain };
[[nodiscard]] Reach reach_of(const shaders::LocalLight& light, const dvec3& point);

/// For each light, the greatest reach of any pixel of a tile.
[[nodiscard]] std::vector<Reach> reach_of_tile(const SearchedScene& scene, uvec2 tile);

}  // namespace gloam::test

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <set>

#include "tests/modules/lights/lists/find_lights_kernels.h"
#include "tests/support/kernel.h"

namespace gloam::test {
namespace {

std::uint32_t rounded(std::uint32_t count) { return (count + 2) / 3 * 3; }

/// The froxel tests of shadows.md §2 and froxel_api.glsl, in double precision. `slack` moves every bound by that share,
/// so that the kernel's result lies between those of a negative and a positive slack.
class FroxelTwin {
 public:
  FroxelTwin(const SearchedScene& scene, uvec2 first, uvec2 last, vec2 bounds, double epsilon, double slack)
      : epsilon_(epsilon + slack), share_(slack) {
    const dmat4 to_view(scene.view.view_from_relative);
    dvec3 low(1e300), high(-1e300);
    for (unsigned i = 0; i < 8; ++i) {
      corner_[i] =
          dvec3(to_view * dvec4(scene.position_at((i & 1) != 0 ? last.x : first.x, (i & 2) != 0 ? last.y : first.y,
                                                  static_cast<double>((i & 4) != 0 ? bounds.y : bounds.x)),
                                0.0));
      low = glm::min(low, corner_[i]);
      high = glm::max(high, corner_[i]);
    }
    const dvec3 reach = glm::max(glm::abs(low), glm::abs(high));
    slack_ = epsilon_ * (reach.x + reach.y + reach.z) + 1e-6;
    center_ = (low + high) * 0.5;
    half_ = (high - low) * 0.5 + slack_;
    for (const dvec3& c : corner_) radius_ = std::max(radius_, glm::length(c - center_));
    radius_ += 2.0 * slack_;
    view_from_relative_ = to_view;
  }

  [[nodiscard]] bool touches(const shaders::LocalLight& light) const {
    const dvec3 position(view_from_relative_ * dvec4(dvec3(light.position), 0.0));
    const dvec3 outside = glm::max(glm::abs(position - center_) - half_, dvec3(0.0));
    const double distance = std::max(glm::length(outside), glm::length(position - center_) - radius_);
    const double range = std::sqrt((1.0 + epsilon_) / static_cast<double>(light.inverse_range_squared));
    if (distance > range + share_ * range) return false;
    return light.spot_scale == 0.0f || touches_cone(light, position);
  }

 private:
  [[nodiscard]] bool touches_cone(const shaders::LocalLight& light, const dvec3& position) const {
    const dvec3 direction(view_from_relative_ * dvec4(dvec3(light.direction), 0.0));
    const double exact = -static_cast<double>(light.spot_offset) / static_cast<double>(light.spot_scale);
    const double half_angle = std::acos(std::clamp(exact - 0.125 * epsilon_, -1.0, 1.0));
    const dvec3 v = center_ - position;
    const double along = glm::dot(v, direction);
    const double across = glm::length(glm::cross(v, direction));
    const double rounding = (1e-6 + share_) * (std::abs(along) + across);
    if (std::cos(half_angle) * across - std::sin(half_angle) * along > radius_ + rounding ||
        along < -radius_ - rounding)
      return false;
    if (exact < 0.5) return true;
    // The four sides of a square pyramid, with axes chosen as in the kernel, and the plane through its apex.
    const dvec3 side = glm::normalize(std::abs(direction.y) < 0.7 ? dvec3(direction.z, 0.0, -direction.x)
                                                                  : dvec3(0.0, -direction.z, direction.y));
    const dvec3 up = glm::cross(direction, side);
    for (const dvec3& axis : {side, -side, up, -up, dvec3(0.0)}) {
      const dvec3 inward =
          axis == dvec3(0.0) ? direction : direction * std::sin(half_angle) + axis * std::cos(half_angle);
      double most = -1e300;
      for (const dvec3& c : corner_) most = std::max(most, glm::dot(inward, c - position));
      if (most < -4.0 * (slack_ + rounding)) return false;
    }
    return true;
  }

  double epsilon_;
  double share_;
  double slack_ = 0.0;
  double radius_ = 0.0;
  std::array<dvec3, 8> corner_{};
  dvec3 center_ = dvec3(0.0);
  dvec3 half_ = dvec3(0.0);
  dmat4 view_from_relative_ = dmat4(1.0);
};

/// Sorted lights between two view depths, from the definition of zBins.
uvec2 range_of(const SearchedScene& scene, double nearest_m, double farthest_m) {
  const auto bin_of = [&](double depth_m) {
    const double bin = (depth_m - static_cast<double>(scene.grid.z_near)) * static_cast<double>(scene.grid.z_scale);
    return static_cast<std::uint32_t>(std::clamp(bin, 0.0, scene.grid.z_bin_count - 1.0));
  };
  const std::uint32_t first = bin_of(nearest_m), last = bin_of(farthest_m);
  if (last - first > 1)
    return {scene.z_bins[scene.grid.z_bin_count + first] & 0xFFFFu, scene.z_bins[scene.grid.z_bin_count + last] >> 16};
  return {std::min(scene.z_bins[first] & 0xFFFFu, scene.z_bins[last] & 0xFFFFu),
          std::max(scene.z_bins[first] >> 16, scene.z_bins[last] >> 16)};
}

struct Band {
  std::vector<bool> least, most;  ///< by light; the kernel's set lies between the two
};

/// The lights of the parent's tile mask, and of those the candidates in the zBins of the tile's depths. A depth near a
/// bin's edge may fall on either side.
std::vector<bool> masked_lights(const SearchedScene& scene, uvec2 tile) {
  const uvec2 parent = tile / 4u;
  const std::uint32_t* words =
      &scene.mask_tiles[(std::size_t{parent.y} * scene.grid.mask_tiles.x + parent.x) * GLOAM_MASK_WORDS];
  std::vector<bool> lights(scene.grid.local_count);
  for (std::uint32_t i = 0; i < lights.size(); ++i)
    lights[i] = (words[0] >> i / 32 & 1u) != 0 && (words[1 + i / 32] >> i % 32 & 1u) != 0;
  return lights;
}
Band candidates(const SearchedScene& scene, std::uint32_t tile) {
  const std::vector<bool> masked = masked_lights(scene, scene.tile_at(tile));
  const auto metres = [&](float depth) {
    return -(dmat4(scene.view.view_from_relative) * dvec4(scene.position_at(0.0, 0.0, static_cast<double>(depth)), 0.0))
                .z;
  };
  const double nearest = metres(scene.bounds[tile].y), farthest = metres(scene.bounds[tile].x);
  Band band{masked, std::vector<bool>(masked.size())};
  for (const double a : {1.0 - 2e-6, 1.0 + 2e-6}) {
    for (const double b : {1.0 - 2e-6, 1.0 + 2e-6}) {
      const uvec2 range = range_of(scene, nearest * a, std::max(farthest * b, nearest * a));
      for (std::uint32_t i = 0; i < masked.size(); ++i) {
        const bool inside = masked[i] && i >= range.x && i < range.y;
        band.least[i] = band.least[i] && inside;
        band.most[i] = band.most[i] || inside;
      }
    }
  }
  return band;
}

/// Farthest and nearest depth of the surfaces in a tile group.
vec2 group_bounds(const SearchedScene& scene, uvec2 group) {
  vec2 bounds(1.0f, 0.0f);
  for (std::uint32_t tile = 0; tile < scene.tile_count(); ++tile)
    if (scene.tile_at(tile) / 8u == group && !scene.is_sky(tile))
      bounds = vec2(std::min(bounds.x, scene.bounds[tile].x), std::max(bounds.y, scene.bounds[tile].y));
  return bounds;
}

/// The lights that the kernel must and may list for a tile.
Band expected_lights(const SearchedScene& scene, std::uint32_t tile) {
  Band band = candidates(scene, tile);
  const uvec2 at = scene.tile_at(tile);
  const uvec2 group = at / 8u;
  const vec2 whole = group_bounds(scene, group);
  for (const double slack : {-2e-5, 2e-5}) {
    const FroxelTwin own(scene, at * 8u, glm::min(at * 8u + 8u, scene.size()), scene.bounds[tile], 1e-4, slack);
    const FroxelTwin shared(scene, group * 64u, glm::min(group * 64u + 64u, scene.size()), whole, 2e-4, slack);
    std::vector<bool>& lights = slack < 0.0 ? band.least : band.most;
    for (std::uint32_t i = 0; i < lights.size(); ++i)
      lights[i] = lights[i] && shared.touches(scene.lights->local[i]) && own.touches(scene.lights->local[i]);
  }
  return band;
}

std::uint32_t count_of(const std::vector<bool>& lights) {
  return static_cast<std::uint32_t>(std::count(lights.begin(), lights.end(), true));
}

void expect_twin(const SearchedScene& scene, const FoundLights& found) {
  std::vector<std::set<std::uint32_t>> least(scene.group_count()), most(scene.group_count());
  std::uint64_t masked = 0, fewest_candidates = 0, most_candidates = 0, approx = 0;
  for (std::uint32_t tile = 0; tile < scene.tile_count(); ++tile) {
    if (scene.is_sky(tile)) {
      EXPECT_EQ(found.tile_lists[tile].y, 0u) << "a tile of sky has no lights";
      continue;
    }
    const Band band = expected_lights(scene, tile);
    EXPECT_GE(found.approx_count(tile), count_of(band.least)) << "tile " << tile;
    EXPECT_LE(found.approx_count(tile), count_of(band.most)) << "tile " << tile;
    EXPECT_EQ(found.accurate_count(tile), 0u);
    const std::uint32_t group = scene.group_of(scene.tile_at(tile));
    for (std::uint32_t i = 0; i < scene.grid.local_count; ++i) {
      if (band.least[i]) least[group].insert(i);
      if (band.most[i]) most[group].insert(i);
    }
    masked += count_of(masked_lights(scene, scene.tile_at(tile)));
    const Band candidate = candidates(scene, tile);
    fewest_candidates += count_of(candidate.least);
    most_candidates += count_of(candidate.most);
    approx += found.approx_count(tile);
  }
  for (std::uint32_t group = 0; group < scene.group_count(); ++group) {
    const std::vector<std::uint32_t> lights = found.group(group);
    EXPECT_TRUE(std::includes(lights.begin(), lights.end(), least[group].begin(), least[group].end()))
        << "group " << group;
    EXPECT_TRUE(std::includes(most[group].begin(), most[group].end(), lights.begin(), lights.end()))
        << "group " << group;
  }
  EXPECT_EQ(found.counters.mask_lights, masked);
  EXPECT_GE(found.counters.candidate_lights, fewest_candidates);
  EXPECT_LE(found.counters.candidate_lights, most_candidates);
  EXPECT_EQ(found.counters.approx_lights, approx);
}

/// Invariants for any order of workgroups: slots do not overlap and leave no gaps, and the counters are the sums of
/// what was written.
void expect_consistent(const SearchedScene& scene, const FoundLights& found) {
  std::vector<uvec2> spans;
  std::uint32_t asked = 0, tiles = 0, overflow = 0, group_lights = 0;
  float farthest = 1.0f;
  for (std::uint32_t tile = 0; tile < scene.tile_count(); ++tile) {
    const std::uint32_t count = found.approx_count(tile);
    asked += rounded(count);
    overflow += found.has_list(tile) ? 0 : 1;
    if (!scene.is_sky(tile)) {
      ++tiles;
      farthest = std::min(farthest, scene.bounds[tile].x);
      group_lights += static_cast<std::uint32_t>(found.group(scene.group_of(scene.tile_at(tile))).size());
    }
    EXPECT_TRUE(count > 0 || found.has_list(tile)) << "an empty list fits anywhere";
    if (count == 0 || !found.has_list(tile)) continue;
    EXPECT_EQ(found.tile_lists[tile].x % 3, 0u);
    const std::uint32_t entries = std::max(rounded(count), scene.grid.fixed_slots);
    EXPECT_LE(found.tile_lists[tile].x + entries, scene.grid.slot_capacity);
    spans.emplace_back(found.tile_lists[tile].x, found.tile_lists[tile].x + entries);
  }
  std::sort(spans.begin(), spans.end(), [](uvec2 a, uvec2 b) { return a.x < b.x; });
  for (std::size_t i = 1; i < spans.size(); ++i) EXPECT_LE(spans[i - 1].y, spans[i].x) << "two tiles share entries";
  if (overflow == 0 && scene.grid.fixed_slots == 0 && !spans.empty()) {
    EXPECT_EQ(spans.back().y, asked) << "no entry lies waste";
  }
  EXPECT_EQ(found.counters.slots, asked);
  EXPECT_EQ(found.counters.tiles, tiles);
  EXPECT_EQ(found.counters.overflow_tiles, overflow);
  EXPECT_EQ(found.counters.group_lights, group_lights);
  EXPECT_EQ(found.counters.farthest_depth, std::bit_cast<std::uint32_t>(farthest));
  for (std::uint32_t group = 0; group < scene.group_count(); ++group) {
    const std::uint32_t* words = &found.group_masks[std::size_t{group} * GLOAM_MASK_WORDS];
    for (std::uint32_t word = 0; word < GLOAM_LIGHT_GROUPS; ++word)
      EXPECT_EQ((words[0] >> word & 1u) != 0, words[1 + word] != 0) << "group " << group << " word " << word;
  }
}

class FindLightsApprox : public KernelTest {
 protected:
  FoundLights run(const SearchedScene& scene) {
    FoundLights found = FindLights(device()).approximate(scene);
    expect_consistent(scene, found);
    return found;
  }
};

TEST_F(FindLightsApprox, lists_what_the_twin_lists_but_for_rounding_at_the_bounds) {
  std::uint32_t seed = 1;
  for (const uvec2 size : {uvec2(203, 117), uvec2(33, 31), uvec2(7, 5), uvec2(1, 1), uvec2(321, 9)})
    for (const bool orthographic : {false, true}) {
      SCOPED_TRACE(seed);
      const SearchedScene scene = random_scene(
          {.width = size.x, .height = size.y, .orthographic = orthographic, .roll = 0.3 * seed}, 700, seed);
      expect_twin(scene, run(scene));
      ++seed;
    }
}

TEST_F(FindLightsApprox, holds_any_number_of_lights_in_one_place) {
  for (const std::uint32_t count : {0u, 1u, 31u, 32u, 33u, 1023u, 1024u}) {
    SCOPED_TRACE(count);
    std::mt19937 random(7);
    SearchedScene scene = empty_scene({.width = 100, .height = 40});
    draw_random_depth(scene, random);
    finish_scene(scene, std::vector<TestLight>(count, TestLight{.range_m = 1000.0}));  // at the camera
    const FoundLights found = run(scene);
    for (std::uint32_t tile = 0; tile < scene.tile_count(); ++tile)
      EXPECT_EQ(found.approx_count(tile), scene.is_sky(tile) ? 0u : count);
    EXPECT_EQ(found.counters.mask_lights, count * found.counters.tiles);
    EXPECT_EQ(found.counters.candidate_lights, count * found.counters.tiles);
  }
}

TEST_F(FindLightsApprox, of_a_picture_of_sky_is_empty) {
  SearchedScene scene = empty_scene({.width = 100, .height = 70});
  std::mt19937 random(3);
  finish_scene(scene, random_lights(scene, 300, random));
  const FoundLights found = run(scene);
  EXPECT_EQ(found.counters.tiles, 0u);
  EXPECT_EQ(found.counters.slots, 0u);
  for (const std::uint32_t word : found.group_masks) EXPECT_EQ(word, 0u);
}

TEST_F(FindLightsApprox, does_not_let_the_sky_beside_a_surface_widen_its_depths) {
  SearchedScene scene = empty_scene({.width = 8, .height = 8});
  for (std::uint32_t i = 0; i < 32; ++i) scene.depth[i] = scene.depth_of(2.0);
  const auto at = [&](double metres) {
    return scene.position_at(4.0, 4.0, static_cast<double>(scene.depth_of(metres)));
  };
  finish_scene(scene, {{.position = at(2.0), .range_m = 0.5}, {.position = at(30.0), .range_m = 5.0}});
  EXPECT_EQ(run(scene).approx_count(0), 1u);
}

/// Five lights and surfaces at two depths, as in the paper's figure 3. The first and last standard bins of [3, 11] hold
/// lights 0 and 1 but not 2; those of [0, 13] hold none.
TEST_F(FindLightsApprox, finds_what_the_first_and_last_bin_do_not_know) {
  const double pairs[][2] = {{3.5, 11.5}, {0.5, 13.5}};
  for (const auto& [nearest, farthest] : pairs) {
    SearchedScene scene = empty_scene({.width = 8, .height = 8, .near_m = 0.01f});
    for (std::uint32_t i = 0; i < 64; ++i) scene.depth[i] = scene.depth_of(i < 32 ? nearest : farthest);
    scene.depth[63] = scene.depth_of(19.99);  // makes a bin one metre wide
    const auto light = [&](double from_m, double to_m) {
      return TestLight{
          .position = scene.position_at(4.0, 4.0, static_cast<double>(scene.depth_of(0.5 * (from_m + to_m)))),
          .range_m = 0.5 * (to_m - from_m)};
    };
    finish_scene(scene, {light(2.2, 8.8), light(4.2, 12.8), light(6.2, 7.8), light(14.2, 16.0), light(15.2, 18.0)},
                 {.z_bin_count = 20});
    // Removes the far texel, which only defined the bins.
    scene.depth[63] = scene.depth[62];
    scene.bounds[0].x = scene.depth[62];
    ASSERT_EQ(scene.lights->local_count, 5u);
    const std::uint32_t first = scene.z_bins[static_cast<std::size_t>(nearest)],
                        last = scene.z_bins[static_cast<std::size_t>(farthest)];
    const std::uint32_t end = std::max(first >> 16, last >> 16);
    EXPECT_LT(end, 3u) << "the standard set would have found the lights: this shows nothing";
    const FoundLights found = run(scene);
    for (const std::uint32_t i : {0u, 1u, 2u}) EXPECT_EQ(found.group(0)[i], i);
    expect_twin(scene, found);
  }
}

TEST_F(FindLightsApprox, that_finds_no_room_marks_and_counts_tiles_and_keeps_the_groups_masks) {
  const SceneSize size{.width = 200, .height = 130};
  const SearchedScene roomy = random_scene(size, 600, 11);
  const FoundLights all = run(roomy);
  ASSERT_EQ(all.counters.overflow_tiles, 0u);
  for (const std::uint32_t capacity : {3u, 300u, all.counters.slots / 2, all.counters.slots - 3, all.counters.slots}) {
    SCOPED_TRACE(capacity);
    const SearchedScene scene = random_scene(size, 600, 11, {.slot_capacity = capacity});
    const FoundLights found = run(scene);
    EXPECT_EQ(found.group_masks, all.group_masks);
    EXPECT_EQ(found.counters.slots, all.counters.slots) << "says how much would have been enough";
    EXPECT_EQ(found.counters.overflow_tiles > 0, scene.grid.slot_capacity < all.counters.slots);
    for (std::uint32_t tile = 0; tile < scene.tile_count(); ++tile)
      EXPECT_EQ(found.approx_count(tile), all.approx_count(tile));
  }
}

TEST_F(FindLightsApprox, with_fixed_slots_puts_lists_where_they_can_be_looked_up) {
  const SceneSize size{.width = 200, .height = 130};
  for (const std::uint32_t slots : {3u, 12u, 1023u}) {
    const SearchedScene scene = random_scene(size, 600, 12, {.slot_capacity = 25 * 17 * slots, .fixed_slots = slots});
    const FoundLights found = run(scene);
    std::uint32_t without = 0;
    for (std::uint32_t tile = 0; tile < scene.tile_count(); ++tile) {
      const bool fits = found.approx_count(tile) <= slots;
      if (!fits) ++without;
      EXPECT_EQ(found.tile_lists[tile].x, fits ? tile * slots : GLOAM_NO_SLOT);
    }
    EXPECT_EQ(found.counters.overflow_tiles, without);
    EXPECT_EQ(without > 0, slots < 100) << "the scene shows nothing";
  }
}

}  // namespace
}  // namespace gloam::test

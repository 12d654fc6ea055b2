// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <random>
#include <vector>

#include "engine/math/packing.h"
#include "engine/render/view.h"
#include "shaders/closeups/closeups_shared.h"
#include "shaders/shadows/final_lists_shared.h"
#include "tests/modules/shadows/rig.h"
#include "tests/modules/shadows/support/final_lists/kernels.h"
#include "tests/modules/shadows/support/maps.h"

// A wall, a close-up pair before it and synthetic lists for compose_kernel_test.cpp, and what a model in double says of
// the wall's pixels.

namespace gloam::test::compose {

inline constexpr std::uint32_t kFace = 256;
inline constexpr std::uint32_t kLight = 37;    ///< index of the pair's light
inline constexpr std::uint32_t kRoom = 64;     ///< space for the entries of one tile
inline constexpr std::uint32_t kPerSlot = 16;  ///< most words per slot
inline constexpr double kWall = 4.0;           ///< metres in front of the camera
inline constexpr double kInner = 0.43;         ///< tangent inside the rim

struct Settings {
  bool directional = false;
  bool standard = false;
  std::uint32_t bits = 8;
  std::uint32_t threads = 64;
  std::uint32_t first_slot = 0;  ///< first slot that the lists use
  std::optional<std::uint32_t> slots_left;
};

/// A wall with holes to the sky. The dispatch covers its tiles except for the first and last column.
struct Wall {
  static constexpr std::uint32_t kWidth = 85, kHeight = 46;
  RenderView view;
  std::vector<float> depth;
  std::vector<uvec2> normals;
  std::vector<std::uint32_t> base_color;
  std::vector<vec2> bounds;  ///< depth bounds by tile
  std::vector<dvec3> points;

  static constexpr uvec2 size() { return {kWidth, kHeight}; }
  static constexpr uvec2 tiles() { return {(kWidth + 7) / 8, (kHeight + 7) / 8}; }
  static constexpr uvec2 first() { return {1, 0}; }
  static constexpr uvec2 end() { return {tiles().x - 1, tiles().y}; }
  static bool covers(std::uint32_t tile) {
    const uvec2 at(tile % tiles().x, tile / tiles().x);
    return at.x >= first().x && at.x < end().x && at.y >= first().y && at.y < end().y;
  }
};

inline Wall make_wall(std::uint32_t seed) {
  ViewSettings settings;
  settings.width = Wall::kWidth;
  settings.height = Wall::kHeight;
  settings.camera.near_m = 0.1f;
  settings.camera.fov_y = 0.7f;
  Wall wall;
  wall.view = make_view(settings, 0);
  wall.bounds.assign(std::size_t{Wall::tiles().x} * Wall::tiles().y, vec2(0.0f));
  std::mt19937 random(seed);
  const double slope = std::tan(0.35), aspect = static_cast<double>(Wall::kWidth) / Wall::kHeight;
  const auto depth = static_cast<float>(0.1 / kWall);
  const std::uint32_t normal = pack_normal_snorm16(vec3(0.0f, 0.0f, 1.0f));
  for (std::uint32_t y = 0; y < Wall::kHeight; ++y)
    for (std::uint32_t x = 0; x < Wall::kWidth; ++x) {
      const bool sky = random() % 17 == 0;
      wall.points.push_back(dvec3((2.0 * (x + 0.5) / Wall::kWidth - 1.0) * slope * aspect,
                                  (1.0 - 2.0 * (y + 0.5) / Wall::kHeight) * slope, -1.0) *
                            kWall);
      wall.depth.push_back(sky ? 0.0f : depth);
      wall.normals.emplace_back(normal, normal);
      wall.base_color.push_back(0x00808080u);
      if (!sky) wall.bounds[y / 8 * Wall::tiles().x + x / 8] = vec2(depth);
    }
  return wall;
}

/// A close-up pair: a light in front of the wall that shines at it, and blockers between.
struct Pair {
  FacePose pose;
  std::vector<float> depths;  ///< of its face
  shaders::CloseupConstants constants{};
};

inline Pair make_pair(const Settings& s) {
  Pair pair;
  pair.pose.origin = s.directional ? dvec3(0.5, 0.3, -1.0) : dvec3(0.5, 0.3, -0.5);
  pair.pose.tan_half = s.directional ? 0.0 : 0.45;
  pair.pose.half_extent_m = 1.6;
  pair.pose.depth_m = 4.0;
  const dvec3 normal(0.0, 0.0, 1.0);
  pair.depths = test::draw_face(
      pair.pose, kFace,
      test::nearest_of(
          {test::plane(dvec3(0.0, 0.0, -2.0), normal,
                       [](const dvec3& p) { return std::abs(p.x - 0.6) < 0.43 && std::abs(p.y - 0.2) < 0.37; }),
           test::plane(dvec3(0.0, 0.0, -2.5), normal,
                       [](const dvec3& p) { return std::abs(p.x + 0.1) < 0.06 && std::abs(p.y - 0.5) < 0.6; })}));
  shaders::CloseupConstants& c = pair.constants;
  c.near_m = static_cast<float>(pair.pose.near_m);
  c.tan_half = static_cast<float>(pair.pose.tan_half);
  c.tan_inner = static_cast<float>(kInner);
  c.right = vec3(1.0f, 0.0f, 0.0f);
  c.up = vec3(0.0f, 1.0f, 0.0f);
  c.size = static_cast<float>(kFace);
  c.origin = vec2(kFace, 0.0f);
  c.first_tile = Wall::first();
  c.end_tile = Wall::end();
  c.pair = 2;
  c.first_item = 9;
  c.light = kLight;
  const double per_m = kFace / (2.0 * pair.pose.half_extent_m);
  c.row_u = vec4(dvec4(per_m, 0.0, 0.0, 0.5 * kFace - per_m * pair.pose.origin.x));
  c.row_v = vec4(dvec4(0.0, -per_m, 0.0, 0.5 * kFace + per_m * pair.pose.origin.y));
  c.row_depth = vec4(dvec4(0.0, 0.0, 1.0 / pair.pose.depth_m, 1.0 - pair.pose.origin.z / pair.pose.depth_m));
  c.direction = vec3(0.0f, 0.0f, -1.0f);
  c.brightest = 1.0f;
  c.texel_m = static_cast<float>(1.0 / per_m);
  c.depth_m = static_cast<float>(pair.pose.depth_m);
  return pair;
}

/// Effect of the close-up on a point. `aside`: outside its face; `either`: depends on rounding and on the filter.
enum class Says : std::uint8_t { aside, lit, unlit, either };

inline Says says_of(const Pair& pair, const Settings& s, const dvec3& point) {
  const dvec3 v = point - pair.pose.origin;
  const double z = -v.z, half = s.directional ? pair.pose.half_extent_m : z * pair.pose.tan_half;
  const double inner = s.directional ? 1.0 : kInner / pair.pose.tan_half;
  const double off = std::max(std::abs(v.x), std::abs(v.y)) / half - inner;
  if (off > 1e-3) return Says::aside;
  if (off > -1e-3) return Says::either;
  const double u = (0.5 + 0.5 * v.x / half) * kFace, w = (0.5 - 0.5 * v.y / half) * kFace;
  const double receiver = s.directional ? 1.0 - z / pair.pose.depth_m : pair.pose.near_m / z;
  // The hard filter reads one texel. The standard filter reads, for lights without width, kernels of eight texels with
  // their gathers.
  const double reach = s.standard ? 9.0 : 0.02;
  bool lit = false, unlit = false;
  for (int y = static_cast<int>(std::floor(w - reach)); y <= static_cast<int>(std::floor(w + reach)); ++y)
    for (int x = static_cast<int>(std::floor(u - reach)); x <= static_cast<int>(std::floor(u + reach)); ++x) {
      if (x < 0 || y < 0 || x >= static_cast<int>(kFace) || y >= static_cast<int>(kFace)) continue;
      const bool blocked = static_cast<double>(pair.depths[static_cast<std::size_t>(y) * kFace + x]) > receiver * 1.001;
      unlit |= blocked;
      lit |= !blocked;
    }
  return lit && unlit ? Says::either : unlit ? Says::unlit : Says::lit;
}

/// The lists, before or after.
struct Lists {
  std::vector<uvec4> tiles;
  std::vector<std::uint32_t> entries;
  std::array<std::vector<std::uint32_t>, 2> words;
  std::vector<shaders::ShadowListCounters> counters{1};
  std::vector<shaders::ShadowListCommands> commands{1};
  std::vector<std::uint32_t> fallback;
  std::vector<shaders::KeptTile> kept;
  std::uint32_t end_slot = 0;

  std::uint32_t& word(const Settings& s, std::uint32_t slot, std::uint32_t i) {
    const std::uint32_t a_slot = 2 * s.bits, per_buffer = GLOAM_BUFFER_WORDS / a_slot;
    return slot < per_buffer ? words[0].at(std::size_t{slot} * a_slot + i)
                             : words[1].at(std::size_t{slot - per_buffer} * a_slot + i);
  }
  std::uint32_t steps(const Settings& s, std::uint32_t slot, std::uint32_t pixel) {
    return word(s, slot, pixel * s.bits / 32) >> pixel * s.bits % 32 & ((1u << s.bits) - 1);
  }
};

/// Runs of 0, 1, 31, 33 or 64 entries, with or without the light, at the first, the last or any position.
inline std::vector<std::uint32_t> random_run(std::mt19937& random, bool with_light) {
  constexpr std::uint32_t kCounts[] = {0, 1, 31, 33, 64};
  const std::uint32_t count = kCounts[random() % 5];
  std::vector<std::uint32_t> others;
  for (std::uint32_t light = 0; light < 100; ++light)
    if (light != kLight) others.push_back(light);
  const auto kind = random() % 4;
  if (with_light && kind == 0) std::erase_if(others, [](std::uint32_t light) { return light < kLight; });
  if (with_light && kind == 1 && count <= kLight)
    std::erase_if(others, [](std::uint32_t light) { return light > kLight; });
  std::shuffle(others.begin(), others.end(), random);
  others.resize(std::min<std::size_t>(others.size(), with_light && count > 0 ? count - 1 : count));
  if (with_light && count > 0) others.push_back(kLight);
  std::sort(others.begin(), others.end());
  return others;
}

inline std::uint32_t random_slot(std::mt19937& random, Lists& lists) {
  const auto kind = random() % 5;
  return kind < 2 ? GLOAM_ALL_LIT : kind == 2 ? GLOAM_ALL_UNLIT : lists.end_slot++;
}

inline Lists make_lists(const Settings& s, std::mt19937& random, bool split) {
  Lists lists;
  lists.end_slot = s.first_slot;
  const uvec2 tiles = Wall::tiles();
  const std::uint32_t count = tiles.x * tiles.y;
  lists.entries.assign(std::size_t{2} * count * kRoom, kGuard);
  for (std::uint32_t tile = 0; tile < count; ++tile) {
    uvec4 texel(tile * kRoom, (count + tile) * kRoom, 0, 0);
    for (const bool directional : {false, true}) {
      // Nine of ten lists of the pair's kind hold its light. So do half of the lists of the other kind, where that
      // index means another light.
      const std::vector<std::uint32_t> run =
          random_run(random, directional == s.directional ? random() % 10 != 0 : random() % 2 == 0);
      const std::uint32_t first = directional ? texel.x : texel.y;
      for (std::size_t i = 0; i < run.size(); ++i) lists.entries[first + i] = run[i] | random_slot(random, lists) << 10;
      texel.z |= static_cast<std::uint32_t>(run.size()) << (directional ? 16 : 0);
    }
    if (random() % 25 == 0) texel = uvec4(GLOAM_NO_FINAL_LIST, GLOAM_NO_FINAL_LIST, 0, 0);
    lists.tiles.push_back(texel);
  }
  const std::size_t most = std::size_t{lists.end_slot + count + 8} * 2 * s.bits;
  lists.words[0].assign(split ? GLOAM_BUFFER_WORDS : most, kGuard);
  lists.words[1].assign(split ? most - GLOAM_BUFFER_WORDS : kPerSlot, kGuard);
  for (std::uint32_t slot = s.first_slot; slot < lists.end_slot; ++slot) {
    const auto kind = random() % 4;
    for (std::uint32_t i = 0; i < 2 * s.bits; ++i)
      lists.word(s, slot, i) = kind == 0 ? 0u : kind == 1 ? ~0u : static_cast<std::uint32_t>(random());
  }
  lists.counters[0].slots = lists.end_slot;
  lists.fallback.assign(count, kGuard);
  lists.kept.assign(count, {uvec4(1), 2, 3, 4, 5, 6});
  return lists;
}

}  // namespace gloam::test::compose

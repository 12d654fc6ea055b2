// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <random>
#include <set>
#include <string>

#include "engine/math/packing.h"
#include "engine/render/camera/view_constants.h"
#include "engine/render/view.h"
#include "modules/shadows/views/cascade_rows.h"
#include "shaders/lights/lights_shared.h"
#include "shaders/shadows/final_lists_shared.h"
#include "shaders/shadows/shaders.h"
#include "tests/modules/shadows/rig.h"
#include "tests/modules/shadows/support/final_lists/kernels.h"
#include "tests/modules/shadows/support/maps.h"

// The shaders of generate.glsl on a synthetic picture, compared with visibilities that probe.comp finds at each pixel's
// point.

namespace gloam {
namespace {

using test::FacePose;
using test::kGuard;

constexpr std::uint32_t kFace = 256;

/// A room seen from inside: a floor 1.5 m below the camera, a wall 5 m in front of it, sky above the wall and in holes.
struct Room {
  RenderView view;
  std::vector<float> depth;
  std::vector<uvec2> normals;
  std::vector<std::uint32_t> base_color;
  std::vector<dvec3> points;  ///< camera-relative

  [[nodiscard]] uvec2 size() const { return {view.width, view.height}; }
  [[nodiscard]] uvec2 tiles() const { return (size() + 7u) / 8u; }
};

Room make_room(std::uint32_t width, std::uint32_t height) {
  ViewSettings settings;
  settings.width = width;
  settings.height = height;
  settings.camera.near_m = 0.1f;
  settings.camera.fov_y = 1.2f;
  settings.world_from_camera = glm::rotate(dmat4(1.0), -0.35, dvec3(1.0, 0.0, 0.0));
  Room room;
  room.view = make_view(settings, 0);
  std::mt19937 random(width);
  const double slope = std::tan(0.6), aspect = static_cast<double>(width) / height;
  for (std::uint32_t y = 0; y < height; ++y)
    for (std::uint32_t x = 0; x < width; ++x) {
      const dvec3 in_view((2.0 * (x + 0.5) / width - 1.0) * slope * aspect, (1.0 - 2.0 * (y + 0.5) / height) * slope,
                          -1.0);
      const dvec3 ray = glm::dmat3(settings.world_from_camera) * in_view;
      const double floor = ray.y < 0.0 ? -1.5 / ray.y : 1e9, wall = ray.z < 0.0 ? -5.0 / ray.z : 1e9;
      const double t = std::min(floor, wall);
      const bool sky = t > 100.0 || (ray * t).y > 1.2 || random() % 23 == 0;
      const std::uint32_t normal = pack_normal_snorm16(floor < wall ? vec3(0, 1, 0) : vec3(0, 0, 1));
      room.points.push_back(ray * t);
      room.depth.push_back(sky ? 0.0f : static_cast<float>(0.1 / t));
      room.normals.emplace_back(normal, normal);
      room.base_color.push_back(0x00808080u);  // not subsurface
    }
  return room;
}

/// The lights of the room: two spots with maps, one that casts no shadow, and two directional lights without maps, one
/// of which shines upward.
struct RoomLights {
  shaders::LightBlock block{};
  std::vector<vec4> texels;
  std::vector<shaders::ShadowRow> rows;
  std::vector<FacePose> faces;
  std::vector<std::vector<float>> depths;
};

FacePose pose_of(const dvec3& position, const dvec3& forward, double tan_half) {
  const dvec3 f = glm::normalize(forward), right = glm::normalize(glm::cross(f, dvec3(0.1, 0.2, 1.0)));
  return {.origin = position, .right = right, .up = glm::cross(right, f), .forward = f, .tan_half = tan_half};
}

RoomLights make_lights() {
  RoomLights lights;
  const test::RayScene scene =
      test::nearest_of({test::plane(dvec3(0.0, -1.5, 0.0), dvec3(0.0, 1.0, 0.0)),
                        test::plane(dvec3(0.0, 0.0, -5.0), dvec3(0.0, 0.0, 1.0)),
                        test::plane(dvec3(0.0, -0.4, 0.0), dvec3(0.0, 1.0, 0.0),
                                    [](const dvec3& p) { return std::abs(p.x) < 0.6 && std::abs(p.z + 3.2) < 0.5; }),
                        test::plane(dvec3(0.0, 0.0, -3.5), dvec3(0.3, 0.0, 1.0),
                                    [](const dvec3& p) { return std::abs(p.x - 1.2) < 0.4 && p.y < 0.0; })});
  const auto add = [&](const dvec3& position, const dvec3& direction, double tan_half, double width, double range) {
    const FacePose pose = pose_of(position, direction, tan_half);
    const bool casts = tan_half > 0.0;
    shaders::LocalLight light{};
    light.position = vec3(position);
    light.inverse_range_squared = static_cast<float>(1.0 / (range * range));
    light.color = vec3(5.0f);
    light.direction = vec3(pose.forward);
    light.spot_offset = 1.0f;
    shaders::ShadowRow row{};
    row.cookie_layer = row.traced_layer = -1.0f;
    if (casts) {
      const double outer = std::atan(0.9 * tan_half);
      light.spot_scale = static_cast<float>(1.0 / (std::cos(0.8 * outer) - std::cos(outer)));
      light.spot_offset = static_cast<float>(-std::cos(outer)) * light.spot_scale;
      row = test::spot_row(pose, 0.9 * tan_half, width, uvec2(lights.depths.size() * kFace, 0), kFace);
      lights.faces.push_back(pose);
      lights.depths.push_back(test::draw_face(pose, kFace, scene));
    }
    lights.block.local[lights.rows.size()] = light;
    lights.rows.push_back(row);
    lights.texels.emplace_back(light.position, light.inverse_range_squared);
    lights.texels.emplace_back(light.color, light.spot_scale);
    lights.texels.emplace_back(light.direction, light.spot_offset);
  };
  add({0.3, 1.5, -3.0}, {0.0, -1.0, -0.1}, 1.0, 0.4, 20.0);
  add({1.0, 0.5, -1.0}, {-0.2, -0.6, -1.0}, 0.9, 0.3, 6.0);
  add({-2.0, 0.0, -4.0}, {0.0, -1.0, 0.0}, 0.0, 0.0, 2.5);
  lights.block.local_count = 3;
  lights.block.directional_count = 2;
  lights.block.directional[0] = {.color = vec3(1.0f), .direction = glm::normalize(vec3(0.2f, -1.0f, -0.5f))};
  lights.block.directional[1] = {.color = vec3(1.0f), .direction = glm::normalize(vec3(0.2f, 1.0f, -0.1f))};
  return lights;
}

/// 1: the light certainly illuminates the point, 0: it certainly does not, −1: rounding decides.
int gives(const shaders::LightBlock& block, bool directional, std::uint32_t light, const dvec3& point,
          const dvec3& normal) {
  const auto sign = [](double value, double margin) { return value > margin ? 1 : value < -margin ? 0 : -1; };
  if (directional) return sign(glm::dot(normal, -dvec3(block.directional[light].direction)), 1e-3);
  const shaders::LocalLight& l = block.local[light];
  const dvec3 offset = dvec3(l.position) - point;
  const double d2 = glm::dot(offset, offset);
  const dvec3 to_light = offset / std::sqrt(d2);
  const int parts[] = {sign(1.0 - d2 * static_cast<double>(l.inverse_range_squared), 1e-3),
                       sign(glm::dot(normal, to_light), 1e-3),
                       sign(glm::dot(-to_light, dvec3(l.direction)) * static_cast<double>(l.spot_scale) +
                                static_cast<double>(l.spot_offset),
                            1e-3)};
  if (std::find(std::begin(parts), std::end(parts), 0) != std::end(parts)) return 0;
  return std::find(std::begin(parts), std::end(parts), -1) != std::end(parts) ? -1 : 1;
}

struct Settings {
  test::ProbeSettings filter;
  std::uint32_t bits = 8;
  std::uint32_t threads = 64;
  std::uint32_t slots_before = 0;  ///< slots that other workgroups have taken
  std::uint32_t slot_capacity = 1u << 20;
  std::uint32_t pair_capacity = 1u << 20;
};

gpu::ShaderCode generate_code(std::uint32_t kind, bool standard) {
  using namespace shaders::shadows;
  if (kind == GLOAM_PAIRS_DIRECTIONAL) return standard ? generate_suns_standard_comp : generate_suns_comp;
  if (kind == GLOAM_PAIRS_IN_FACE) return standard ? generate_in_face_standard_comp : generate_in_face_comp;
  return standard ? generate_crossing_standard_comp : generate_crossing_comp;
}

/// The entries after classification, and the output of the shaders.
struct Generated {
  std::vector<std::uint32_t> entries_before, entries, pairs;
  std::array<std::vector<std::uint32_t>, 2> words;
  std::vector<shaders::ShadowListCounters> counters{1};
};

class GenerateShadows : public test::ShadowKernelTest {
 protected:
  Generated generate(const Room& room, const RoomLights& lights, test::ShadowMaps& maps, const Settings& s,
                     std::size_t first_words, std::size_t more_words) {
    Generated g;
    const uvec2 tiles = room.tiles();
    const std::uint32_t count = tiles.x * tiles.y, suns = lights.block.directional_count,
                        local = lights.block.local_count;
    for (std::uint32_t tile = 0; tile < count; ++tile)
      for (std::uint32_t i = 0; i < suns; ++i) g.entries.push_back(tile << 10 | i);
    for (std::uint32_t tile = 0; tile < count; ++tile)
      for (std::uint32_t i = 0; i < local; ++i) g.entries.push_back(tile << 10 | i);
    for (std::uint32_t i = 0; i < g.entries.size(); ++i) g.pairs.push_back(i);
    std::mt19937 random(count);
    std::shuffle(g.pairs.begin(), g.pairs.end(), random);
    g.entries_before = g.entries;
    g.words = {std::vector<std::uint32_t>(first_words, kGuard), std::vector<std::uint32_t>(more_words, kGuard)};
    g.counters[0].pairs = static_cast<std::uint32_t>(g.pairs.size());
    g.counters[0].slots = s.slots_before;
    shaders::FinalGrid grid{};
    grid.tiles = tiles;
    grid.directional_count = suns;
    grid.has_early_lists = 1;
    grid.entry_capacity = static_cast<std::uint32_t>(g.entries.size());
    grid.pair_capacity = s.pair_capacity;
    grid.slot_capacity = s.slot_capacity;

    // All pairs are in-face pairs; the shader for crossing pairs must give the same results.
    const std::uint32_t local_kind = s.threads == 16 ? GLOAM_PAIRS_CROSSING : GLOAM_PAIRS_IN_FACE;
    shaders::ShadowListCommands commands{};
    for (uvec4& kind : commands.pairs) kind = {GLOAM_PAIRS_ROW, 0, 1, 0};
    std::vector<std::uint32_t> pair_words(2 * std::size_t{s.pair_capacity}, ~0u);
    for (std::size_t i = 0; i < std::min<std::size_t>(g.pairs.size(), s.pair_capacity); ++i) {
      const std::uint32_t kind = g.pairs[i] < count * suns ? GLOAM_PAIRS_DIRECTIONAL : local_kind;
      const std::uint32_t at = commands.pairs[kind].w++;
      commands.pairs[kind].y = at / GLOAM_PAIRS_ROW + 1;
      const std::uint32_t place = kind == GLOAM_PAIRS_IN_FACE    ? at
                                  : kind == GLOAM_PAIRS_CROSSING ? s.pair_capacity - 1 - at
                                                                 : s.pair_capacity + at;
      pair_words[place] = g.pairs[i] | (i % 2 == 0 ? GLOAM_PARTLY_REACHED : 0u);  // only a hint
    }
    shaders::ShadowBlock block = test::shadow_block(maps);
    std::vector<shaders::ShadowRow> rows = lights.rows;
    std::vector<DirectionalLook> looks;
    for (std::uint32_t i = 0; i < suns; ++i) looks.push_back({lights.block.directional[i].direction, 1.0f});
    append_cascade_rows(looks, block, rows);

    test::ListDispatch d(device());
    d.input(0, std::vector{view_constants(room.view)});
    d.input(2, std::vector{grid});
    d.sampled(3, gpu::Format::r32_float, room.size(), room.depth);
    d.sampled(4, gpu::Format::rg32_uint, room.size(), room.normals);
    d.sampled(5, gpu::Format::rgba8_unorm, room.size(), room.base_color);
    d.sampled(6, gpu::Format::rgba32_float, {3, local}, lights.texels);
    d.input(7, pair_words);
    d.in_out(8, g.entries);
    d.in_out(9, g.words[0]);
    d.in_out(10, g.words[1]);
    d.in_out(11, g.counters);
    d.input(12, std::vector{block});
    d.sampled(13, gpu::Format::rgba32_float, {GLOAM_SHADOW_ROW_TEXELS, static_cast<std::uint32_t>(rows.size())}, rows);
    d.sampled(14, maps.atlas_image());
    d.sampled(15, maps.pyramid_image());
    const std::vector<std::uint32_t> white(1, ~0u);
    d.sampled(16, gpu::Format::rgba8_unorm, {1, 1}, white, gpu::ImageShape::array);
    d.sampled(17, gpu::Format::rgba8_unorm, {1, 1}, white, gpu::ImageShape::array);
    d.input(18, std::vector{commands});
    d.input(19, std::vector<std::uint32_t>{0});                               // no tile is reserved
    d.sampled(21, gpu::Format::rg32_uint, {1, 1}, std::vector<uvec2>(1));     // not read: no terminator
    d.sampled(22, gpu::Format::rgba16_float, {1, 1}, std::vector<uvec2>(1));  // not read: no light passes through
    auto constants = s.filter.constants();
    constants.set("local_size_x", s.threads);
    constants.set("kVisibilityBits", s.bits);
    for (std::uint32_t kind = 0; kind < GLOAM_PAIR_KINDS; ++kind) {
      if (commands.pairs[kind].w == 0) continue;
      const auto pipeline = test::value_of(device().create_pipeline(
          gpu::ComputePipelineDesc{"generate_shadows", "test", generate_code(kind, s.filter.standard), constants}));
      d.run(pipeline, {commands.pairs[kind].x, commands.pairs[kind].y});
      device().destroy(pipeline);
    }
    return g;
  }

  /// Expected visibility of each local light at each pixel, in steps.
  static std::vector<std::uint32_t> truth(const Room& room, const RoomLights& lights, test::ShadowMaps& maps,
                                          const Settings& s) {
    std::vector<shaders::ShadowProbe> probes;
    for (std::uint32_t light = 0; light < lights.block.local_count; ++light)
      for (std::size_t i = 0; i < room.points.size(); ++i)
        probes.push_back({.position = vec3(room.points[i]),
                          .light = light,
                          .face_normal = unpack_normal_snorm16(room.normals[i].y),
                          .light_vector = lights.block.local[light].position});
    const auto results = maps.probe(probes, lights.rows, test::shadow_block(maps), s.filter);
    std::vector<std::uint32_t> steps;
    for (const auto& result : results)
      steps.push_back(
          static_cast<std::uint32_t>(std::lround(result.visibility * static_cast<float>((1u << s.bits) - 1))));
    return steps;
  }

  struct Tally {
    std::uint32_t lit = 0, unlit = 0, slots = 0, without_room = 0;
    std::size_t pixels = 0, off = 0;
    std::set<std::uint32_t> taken;
  };

  Tally expect_right(const Room& room, const RoomLights& lights, const Generated& g, const Settings& s,
                     const std::vector<std::uint32_t>& seen) {
    Tally tally;
    const uvec2 tiles = room.tiles();
    const std::uint32_t suns = lights.block.directional_count, local = lights.block.local_count;
    const std::uint32_t of_suns = tiles.x * tiles.y * suns, most = (1u << s.bits) - 1;
    for (std::uint32_t i = 0; i < g.entries.size(); ++i) {
      const bool directional = i < of_suns;
      const std::uint32_t light = directional ? i % suns : (i - of_suns) % local;
      const std::uint32_t tile = directional ? i / suns : (i - of_suns) / local;
      EXPECT_EQ(g.entries[i] & 1023u, light) << "entry " << i;
      check_entry(room, lights, g, s, seen, {tile % tiles.x, tile / tiles.x}, directional, light, g.entries[i] >> 10,
                  most, tally);
      if (HasFailure()) {
        ADD_FAILURE() << (directional ? "sun " : "lamp ") << light << " of tile " << tile << ", " << s.bits << " bits, "
                      << s.threads << " threads, filter " << s.filter.filter;
        return tally;
      }
    }
    const auto& c = g.counters[0];
    EXPECT_EQ(c.lit_by_filter, tally.lit);
    EXPECT_EQ(c.unlit_by_filter, tally.unlit);
    EXPECT_EQ(c.slots - s.slots_before, tally.slots + tally.without_room);
    EXPECT_EQ(tally.taken.size(), tally.slots) << "each slot is one entry's";
    if (!tally.taken.empty()) {
      EXPECT_EQ(*tally.taken.begin(), s.slots_before);
      EXPECT_EQ(*tally.taken.rbegin(), s.slots_before + tally.slots - 1) << "slots are given one after the other";
    }
    // Differences by rounding of positions must be rare, and small (see check_entry).
    EXPECT_LE(tally.off * 50, tally.pixels);
    return tally;
  }

  void check_entry(const Room& room, const RoomLights& lights, const Generated& g, const Settings& s,
                   const std::vector<std::uint32_t>& seen, uvec2 tile, bool directional, std::uint32_t light,
                   std::uint32_t slot, std::uint32_t most, Tally& tally) {
    const bool stored = slot < GLOAM_NO_ROOM;
    bool less = false, any = false, maybe_less = false, maybe_any = false;
    for (std::uint32_t p = 0; p < 64; ++p) {
      const uvec2 pixel = tile * 8u + uvec2(p & 7u, p >> 3);
      const bool inside = pixel.x < room.view.width && pixel.y < room.view.height;
      const std::size_t at = std::size_t{pixel.y} * room.view.width + pixel.x;
      const bool surface = inside && room.depth[at] > 0.0f;
      const std::uint32_t there = stored ? stored_steps(g, s, slot, p) : 0;
      if (!surface) {
        EXPECT_EQ(there, 0u) << "no surface at " << pixel.x << ',' << pixel.y;
        continue;
      }
      const int given =
          gives(lights.block, directional, light, room.points[at], dvec3(unpack_normal_snorm16(room.normals[at].x)));
      const std::uint32_t steps = directional ? most : seen[light * room.points.size() + at];
      maybe_less |= given != 0 && steps < most;
      maybe_any |= given != 0 && steps > 0;
      less |= given == 1 && steps + 2 < most;
      any |= given == 1 && steps > 2;
      if (!stored) continue;
      if (given == 0) {
        EXPECT_EQ(there, 0u) << "the light gives nothing at " << pixel.x << ',' << pixel.y;
      } else if (given == 1) {
        ++tally.pixels;
        const std::uint32_t off = there > steps ? there - steps : steps - there;
        tally.off += off != 0 ? 1 : 0;
        EXPECT_LE(off, 4u) << there << " of " << steps << " at " << pixel.x << ',' << pixel.y;
      }
    }
    if (slot == GLOAM_ALL_LIT) {
      ++tally.lit;
      EXPECT_FALSE(less);
      EXPECT_TRUE(maybe_any);
    } else if (slot == GLOAM_ALL_UNLIT) {
      ++tally.unlit;
      EXPECT_FALSE(any);
    } else {
      EXPECT_TRUE(maybe_less && maybe_any);
      EXPECT_LT(slot, std::max(s.slot_capacity, GLOAM_NO_ROOM + 1));
      stored ? ++tally.slots : ++tally.without_room;
      if (stored) tally.taken.insert(slot);
    }
  }
  static std::uint32_t stored_steps(const Generated& g, const Settings& s, std::uint32_t slot, std::uint32_t pixel) {
    const std::size_t words = 2 * s.bits, per_buffer = GLOAM_BUFFER_WORDS / words;
    const std::vector<std::uint32_t>& buffer = g.words[slot < per_buffer ? 0 : 1];
    const std::size_t at = (slot < per_buffer ? slot : slot - per_buffer) * words + pixel * s.bits / 32;
    if (at >= buffer.size()) {
      ADD_FAILURE() << "slot " << slot << " lies beyond the buffer";
      return 0;
    }
    return buffer[at] >> pixel * s.bits % 32 & ((1u << s.bits) - 1);
  }
  static void expect_untouched(const std::vector<std::uint32_t>& words, std::size_t from, std::size_t to) {
    for (std::size_t i = from; i < to; ++i) ASSERT_EQ(words[i], kGuard) << "word " << i;
  }

  void add_faces(test::ShadowMaps& maps, const RoomLights& lights) const {
    for (std::size_t i = 0; i < lights.depths.size(); ++i) maps.add_face(lights.depths[i], uvec2(i * kFace, 0), kFace);
  }
};

TEST_F(GenerateShadows, give_each_pair_what_its_pixels_see) {
  const RoomLights lights = make_lights();
  test::ShadowMaps maps(device(), 2 * kFace);
  add_faces(maps, lights);
  const Room small = make_room(37, 21), large = make_room(120, 72);
  test::ProbeSettings standard{.levels = 255, .standard = true}, four{.levels = 15, .standard = true},
      pcf{.filter = 1, .levels = 255};
  for (const Settings& s :
       {Settings{.filter = standard, .threads = 8}, Settings{.filter = standard, .threads = 64},
        Settings{.filter = four, .bits = 4, .threads = 16}, Settings{.filter = pcf, .threads = 32}}) {
    for (const Room* room : {&small, &large}) {
      const auto seen = truth(*room, lights, maps, s);
      const Generated g = generate(*room, lights, maps, s, 1 << 16, 16);
      const Tally tally = expect_right(*room, lights, g, s, seen);
      if (HasFailure()) return;
      expect_untouched(g.words[0], tally.slots * 2 * s.bits, g.words[0].size());
      expect_untouched(g.words[1], 0, g.words[1].size());
      EXPECT_GE(tally.slots, 3u);
      EXPECT_GE(tally.lit, 3u);
      EXPECT_GE(tally.unlit, 3u);
      EXPECT_EQ(tally.without_room, 0u);
    }
  }
}

// Hard case: shadows.full_visibility
TEST_F(GenerateShadows, without_room_write_nothing_and_say_so) {
  const RoomLights lights = make_lights();
  test::ShadowMaps maps(device(), 2 * kFace);
  add_faces(maps, lights);
  const Room room = make_room(80, 48);
  Settings s{.filter = {.levels = 255, .standard = true}, .threads = 8};
  const auto seen = truth(room, lights, maps, s);
  const Tally all = expect_right(room, lights, generate(room, lights, maps, s, 1 << 16, 16), s, seen);
  ASSERT_GE(all.slots, 8u);
  for (const std::uint32_t capacity : {0u, 1u, all.slots / 2, all.slots - 1, all.slots}) {
    s.slot_capacity = capacity;
    const Generated g = generate(room, lights, maps, s, 1 << 16, 16);
    const Tally tally = expect_right(room, lights, g, s, seen);
    EXPECT_EQ(tally.slots, capacity);
    EXPECT_EQ(tally.without_room, all.slots - capacity);
    EXPECT_EQ(tally.lit, all.lit);
    EXPECT_EQ(tally.unlit, all.unlit);
    expect_untouched(g.words[0], capacity * 16, g.words[0].size());
  }
}

TEST_F(GenerateShadows, of_pairs_beyond_the_buffer_are_left_alone) {
  const RoomLights lights = make_lights();
  test::ShadowMaps maps(device(), 2 * kFace);
  add_faces(maps, lights);
  const Room room = make_room(40, 24);
  const Settings s{.filter = {.levels = 255, .standard = true}, .threads = 8, .pair_capacity = 20};
  const Generated g = generate(room, lights, maps, s, 1 << 16, 16);
  for (std::size_t i = 20; i < g.pairs.size(); ++i) {
    const std::uint32_t entry = g.pairs[i];
    EXPECT_EQ(g.entries[entry], g.entries_before[entry]) << "pair " << i;
  }
  const auto& c = g.counters[0];
  EXPECT_EQ(c.lit_by_filter + c.unlit_by_filter + c.slots, 20u);
}

// A slot beyond the 128 MiB of the first buffer is in the second one.
TEST_F(GenerateShadows, go_on_in_the_second_buffer_where_the_first_ends) {
  const RoomLights lights = make_lights();
  test::ShadowMaps maps(device(), 2 * kFace);
  add_faces(maps, lights);
  const Room room = make_room(80, 48);
  constexpr std::uint32_t kPerBuffer = GLOAM_BUFFER_WORDS / 16;
  const Settings s{.filter = {.levels = 255, .standard = true},
                   .threads = 8,
                   .slots_before = kPerBuffer - 4,
                   .slot_capacity = 2 * kPerBuffer - 3};
  const auto seen = truth(room, lights, maps, s);
  const Generated g = generate(room, lights, maps, s, GLOAM_BUFFER_WORDS, 1 << 16);
  const Tally tally = expect_right(room, lights, g, s, seen);
  ASSERT_GE(tally.slots, 8u);
  expect_untouched(g.words[0], GLOAM_BUFFER_WORDS - 4 * 16 - 4096, GLOAM_BUFFER_WORDS - 4 * 16);
  expect_untouched(g.words[0], 0, 4096);
  expect_untouched(g.words[1], (tally.slots - 4) * 16, g.words[1].size());
}

}  // namespace
}  // namespace gloam

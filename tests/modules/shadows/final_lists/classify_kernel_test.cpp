// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/modules/shadows/support/final_lists/classify_kernels.h"
#include "tests/support/scale.h"

// The shaders of classify.glsl on synthetic tiles and maps. Their verdicts are compared with a brute-force search of
// the maps (ClassifyOracle) and with the visibilities that probe.comp finds at each pixel.

namespace gloam::test {
namespace {

/// A light, its receiver and its part of a cube, for scenes of which everything is known.
struct SimpleScene {
  ClassifyScene scene;
  dvec3 normal = dvec3(0.0);  ///< of the receiver through kClassifyMiddle
  dvec3 from_light = dvec3(0.0);
};

/// All lights are in the same direction from kClassifyMiddle, which is at this part of the cube. Tiles in the middle of
/// the picture are on a plane that faces the lights.
SimpleScene simple_scene(CubePart part, std::uint32_t seed, double width, std::uint32_t face_size = 64) {
  std::mt19937 random(seed);
  SimpleScene s{.scene = empty_classify_scene(face_size)};
  do {
    s.from_light = direction_to(part, random);
    s.normal = glm::normalize(0.3 * random_unit(random) - s.from_light);
  } while (s.normal.z < 0.3);
  const dvec3 position = kClassifyMiddle - 2.0 * s.from_light;
  s.scene.lights = {classify_spot(position, s.from_light, 0.9, width), classify_cube(position, width),
                    classify_sun(s.from_light, kClassifyMiddle, {1.0, 2.0}, 0.3 * width, face_size)};
  for (std::uint32_t y = 3; y < 6; ++y)
    for (std::uint32_t x = 4; x < 8; ++x)
      fill_group(s.scene, y * 12 + x, 0, uvec2(0), uvec2(7), kClassifyMiddle, s.normal);
  return s;
}

TEST_F(ClassifyKernels, decide_all_tiles_below_an_empty_map_and_behind_a_wall) {
  for (const CubePart part : {CubePart::face_middle, CubePart::edge, CubePart::corner})
    for (const double width : {0.0, 0.05}) {
      SimpleScene s = simple_scene(part, 7, width, 128);
      const auto expect_slots = [&](std::uint32_t slot, const RayScene& casters, const char* what) {
        draw_classify_maps(s.scene, casters);
        const Classified c = classify(s.scene);
        expect_agreement(s.scene, c, ClassifyOptions().pair_capacity);
        for (std::size_t light = 0; light < kClassifyLights; ++light) {
          std::uint32_t count = 0, others = 0;
          for (std::size_t tile = 0; tile < s.scene.tiles.size(); ++tile) {
            if (s.scene.tiles[tile].groups[0].empty()) continue;
            count += c.slot(tile, light) == slot ? 1 : 0;
            others += c.slot(tile, light) != slot && c.slot(tile, light) >= GLOAM_NO_ROOM ? 1 : 0;
          }
          EXPECT_EQ(others, 0u) << what;
          // Near edges of a cube, a tile is decided only if no kernel reads a face that does not hold the tile.
          const std::uint32_t least = light != 1                      ? 10
                                      : part == CubePart::face_middle ? 12
                                      : slot == GLOAM_ALL_LIT         ? 11
                                                                      : 1;
          EXPECT_GE(count, least) << what << ", " << kClassifyLightNames[light] << ", part " << static_cast<int>(part);
        }
      };
      const RayScene receiver = plane(kClassifyMiddle, s.normal);
      const dvec3 half_way = kClassifyMiddle - s.from_light;
      expect_slots(GLOAM_ALL_LIT, nearest_of({}), "empty maps");
      expect_slots(GLOAM_ALL_LIT, receiver, "the receiver alone");
      expect_slots(GLOAM_ALL_UNLIT, nearest_of({receiver, rectangle(half_way, s.from_light, glm::dvec2(3.0))}),
                   "a wall");
    }
}

/// Bias of a light at kClassifyMiddle in metres: kClassifyBiasM at 5 m from a lamp, which is 2 m away, and in a map of
/// the sun with texels of 1 cm, which are 2 m / 128 wide.
double bias_of(std::size_t light) { return kClassifyBiasM * (light == 2 ? 2.0 / 128.0 / 0.01 : 2.0 / 5.0); }

// A sheet of less than the bias above the receiver does not block, a higher one does.
TEST_F(ClassifyKernels, see_sheets_that_are_higher_than_the_bias) {
  SimpleScene s = simple_scene(CubePart::face_middle, 7, 0.02, 128);
  constexpr std::uint32_t kTile = 4 * 12 + 6;
  // Pixels of odd rows are above the sheet in half of the cases, which must not hide it from the others.
  for (const double rise : {0.0, 0.012})
    for (const double height_m : {0.0003, 0.0013, 0.005, 0.008}) {
      fill_group(s.scene, kTile, 0, uvec2(0), uvec2(7), kClassifyMiddle, s.normal, rise);
      const dvec3 sheet = s.scene.tiles[kTile].groups[0][4].position - height_m * s.from_light;
      draw_classify_maps(s.scene,
                         nearest_of({plane(kClassifyMiddle, s.normal), rectangle(sheet, s.normal, glm::dvec2(0.15))}));
      const Classified c = classify(s.scene);
      expect_as_searched(s.scene, c, 31);
      for (std::size_t light = 0; light < kClassifyLights; ++light)
        EXPECT_EQ(c.slot(kTile, light), height_m < 0.75 * bias_of(light) ? GLOAM_ALL_LIT : kTile)
            << kClassifyLightNames[light] << ", " << height_m / bias_of(light) << " times the bias, rise " << rise;
    }
}

// Subsurface materials have four times the bias: a sheet that hides the light from others does not hide it from them.
TEST_F(ClassifyKernels, let_light_through_a_sheet_near_subsurface_materials) {
  SimpleScene s = simple_scene(CubePart::face_middle, 7, 0.0, 128);
  constexpr std::uint32_t kTile = 4 * 12 + 6;
  for (const bool subsurface : {false, true})
    for (const std::size_t light : {0u, 2u}) {
      const dvec3 sheet = kClassifyMiddle - 2.5 * bias_of(light) * s.from_light;
      fill_group(s.scene, kTile, 0, uvec2(0), uvec2(7), kClassifyMiddle, -s.from_light);
      for (ClassifyPixel& pixel : s.scene.tiles[kTile].groups[0]) pixel.subsurface = subsurface;
      draw_classify_maps(s.scene, plane(sheet, s.from_light));
      const Classified c = classify(s.scene);
      expect_as_searched(s.scene, c, 31);
      EXPECT_EQ(c.slot(kTile, light) == GLOAM_ALL_UNLIT, !subsurface) << kClassifyLightNames[light];
    }
}

// Single texels that block one pixel. Each map holds one of them.
TEST_F(ClassifyKernels, see_single_texels) {
  SimpleScene s = simple_scene(CubePart::face_middle, 7, 0.0, 128);
  constexpr std::uint32_t kTile = 4 * 12 + 6;
  const std::vector<ClassifyPixel>& pixels = s.scene.tiles[kTile].groups[0];
  std::mt19937 random(3);
  int tested = 0;
  for (int trial = 0; trial < 24; ++trial) {
    draw_classify_maps(s.scene, plane(kClassifyMiddle, s.normal));
    const ClassifyPixel& pixel = pixels[random() % pixels.size()];
    for (ClassifyLight& light : s.scene.lights) {
      const ClassifyOracle oracle(light, 128, kClassifyBiasM);
      light.faces[static_cast<std::size_t>(oracle.face_of(pixel))].depths[oracle.texel_of(pixel)] *= 1.02f;
    }
    const Classified c = classify(s.scene);
    for (std::size_t light = 0; light < kClassifyLights; ++light) {
      if (!ClassifyOracle(s.scene.lights[light], 128, kClassifyBiasM).is_partly_hidden(pixel)) continue;
      EXPECT_EQ(c.slot(kTile, light), kTile) << kClassifyLightNames[light] << ", trial " << trial;
      ++tested;
    }
  }
  EXPECT_GE(tested, 48);
}

// Blocks of texels that only a test of each texel shows to be harmless, and a blocker after more of them than the
// shader tests texel by texel.
TEST_F(ClassifyKernels, leave_a_tile_open_if_not_all_blocks_are_tested) {
  SimpleScene s = simple_scene(CubePart::face_middle, 7, 0.3, 128);
  constexpr std::uint32_t kTile = 4 * 12 + 6;
  for (ClassifyTile& tile : s.scene.tiles) tile.groups[0].clear();
  fill_group(s.scene, kTile, 0, uvec2(3), uvec2(4), kClassifyMiddle, s.normal);
  const ClassifyPixel& pixel = s.scene.tiles[kTile].groups[0][0];
  draw_classify_maps(s.scene, plane(kClassifyMiddle, s.normal));
  for (ClassifyLight& light : s.scene.lights) {
    const ClassifyOracle oracle(light, 128, kClassifyBiasM);
    std::vector<float>& depths = light.faces[static_cast<std::size_t>(oracle.face_of(pixel))].depths;
    for (std::size_t i = 0; i < depths.size(); ++i) depths[i] *= i % 8 < 4 ? 0.8f : 1.0f;
    // To the lower right of the pixel.
    const std::size_t blocker = oracle.texel_of(pixel) + 8 * 128 + 8;
    for (const std::size_t i : {blocker, blocker + 1, blocker + 128, blocker + 129})
      depths[i] = depths[i] * 0.5f + (light.kind == CastKind::sun ? 0.65f : 0.2f);
    EXPECT_TRUE(oracle.is_partly_hidden(pixel)) << static_cast<int>(light.kind);
  }
  const Classified c = classify(s.scene);
  for (std::size_t light = 0; light < kClassifyLights; ++light)
    EXPECT_EQ(c.slot(kTile, light), kTile) << kClassifyLightNames[light];
}

// Emitters that the plane of the surface cuts, that are below it, or above it. The shading normal faces all of them.
TEST_F(ClassifyKernels, leave_a_tile_open_if_its_plane_cuts_the_emitter) {
  constexpr std::uint32_t kTile = 4 * 12 + 6;
  constexpr double kWidth = 0.6;  // half of it is seen at a sine of 0.15 by local lights, and of 0.09 by the sun
  for (const double sine : {-0.3, -0.06, 0.06, 0.3}) {
    SimpleScene s = simple_scene(CubePart::face_middle, 7, kWidth, 64);
    const dvec3 across = glm::normalize(glm::cross(s.from_light, glm::cross(s.normal, s.from_light)));
    for (ClassifyTile& tile : s.scene.tiles) tile.groups[0].clear();
    fill_group(s.scene, kTile, 0, uvec2(3), uvec2(4), kClassifyMiddle,
               glm::normalize(across * std::sqrt(1.0 - sine * sine) + s.from_light * sine));
    ASSERT_FALSE(s.scene.tiles[kTile].groups[0].empty());
    for (ClassifyPixel& pixel : s.scene.tiles[kTile].groups[0]) pixel.shading_normal = -s.from_light;
    draw_classify_maps(s.scene, nearest_of({}));
    const Classified c = classify(s.scene);
    expect_as_searched(s.scene, c, 31);
    for (std::size_t light = 0; light < kClassifyLights; ++light)
      EXPECT_EQ(c.slot(kTile, light), sine < -0.2  ? GLOAM_ALL_LIT
                                      : sine > 0.2 ? GLOAM_ALL_UNLIT
                                                   : kTile)
          << kClassifyLightNames[light] << ", sine " << sine;
  }
}

// Tiles inside the first cascade, across its border, and outside all cascades.
TEST_F(ClassifyKernels, of_a_sun_combine_the_cascades_of_all_pixels) {
  SimpleScene s = simple_scene(CubePart::face_middle, 3, 0.0);
  s.from_light = dvec3(0.0, 0.0, -1.0);
  const std::uint32_t middle = 4 * 12 + 6;
  const auto slot_of_sun = [&](const glm::dvec2& half_extents, double offset, const RayScene& casters) {
    s.scene.lights[2] = classify_sun(s.from_light, kClassifyMiddle + dvec3(offset, 0.0, 0.0), half_extents, 0.0, 64);
    fill_group(s.scene, middle, 0, uvec2(0), uvec2(7), kClassifyMiddle, dvec3(0.0, 0.0, 1.0));
    draw_classify_maps(s.scene, casters);
    const Classified c = classify(s.scene);
    expect_as_searched(s.scene, c, 31);
    return c.slot(middle, 2);
  };
  const double pixel = s.scene.tiles[middle].groups[0][1].position.x - s.scene.tiles[middle].groups[0][0].position.x;
  const double tile = s.scene.tiles[middle].groups[0][4].position.x;
  const RayScene receiver = plane(kClassifyMiddle, dvec3(0.0, 0.0, 1.0));
  const RayScene wall = nearest_of({receiver, rectangle(dvec3(0.0, 0.0, -3.0), dvec3(0.0, 0.0, 1.0), glm::dvec2(9.0))});
  const double inner = 0.875;  // share of a cascade's half extent without the rim
  for (const auto& [casters, verdict] : {std::pair{receiver, GLOAM_ALL_LIT}, std::pair{wall, GLOAM_ALL_UNLIT}}) {
    EXPECT_EQ(slot_of_sun({1.0, 2.0}, tile, casters), verdict) << "inside the first cascade";
    EXPECT_EQ(slot_of_sun({1.0, 2.0}, tile + inner, casters), verdict) << "across the border of the first cascade";
    EXPECT_EQ(slot_of_sun({1.0, 2.0}, tile + 1.4, casters), verdict) << "inside the second cascade";
    EXPECT_EQ(slot_of_sun({1.0, 2.0}, tile + 2.0 * inner + 8.0 * pixel, casters), GLOAM_ALL_LIT) << "outside of both";
  }
  EXPECT_EQ(slot_of_sun({1.0, 2.0}, tile + 2.0 * inner, receiver), GLOAM_ALL_LIT) << "across the border of the second";
  EXPECT_EQ(slot_of_sun({1.0, 2.0}, tile + 2.0 * inner, wall), middle) << "across the border of the second";
  // A wall that only the second cascade sees: the pixels in the first cascade are lit.
  SimpleScene split = s;
  split.scene.lights[2] =
      classify_sun(s.from_light, kClassifyMiddle + dvec3(tile + inner, 0.0, 0.0), {1.0, 2.0}, 0.0, 64);
  draw_classify_maps(split.scene, wall);
  for (float& depth : split.scene.lights[2].faces[0].depths) depth = 0.0f;
  EXPECT_EQ(classify(split.scene).slot(middle, 2), middle) << "lit in the first cascade, unlit in the second";
}

/// A pixel whose normals are up to `bend` away from those of its group.
void bend_normals(std::vector<ClassifyPixel>& group, double bend, double shading_bend, std::mt19937& random) {
  for (ClassifyPixel& pixel : group) {
    if (bend > 0.0) pixel.face_normal = glm::normalize(pixel.face_normal + bend * random_unit(random));
    pixel.shading_normal = glm::normalize(pixel.face_normal + shading_bend * random_unit(random));
  }
}

/// Tiles on the receiver, near it, and anywhere.
void place_tiles(ClassifyScene& scene, const dvec3& receiver_normal, std::mt19937& random) {
  for (std::size_t tile = 0; tile < scene.tiles.size(); ++tile) {
    const bool whole = random() % 3 != 0, two = random() % 4 == 0;
    const uvec2 first = whole ? uvec2(0) : uvec2(random() % 4, random() % 4);
    const uvec2 last = whole ? uvec2(7) : first + uvec2(random() % 4, random() % 4);
    for (std::size_t g = 0; g < (two && whole ? 2u : 1u); ++g) {
      dvec3 point = kClassifyMiddle, normal = receiver_normal;
      const auto where = random() % 10;
      const double rise = where == 6 ? 0.02 : 0.0;
      if (where == 7 || where == 8) point += normal * between(random, -0.3, 0.3);
      if (where == 9) {
        point = dvec3(between(random, -2.0, 2.0), between(random, -1.5, 1.5), -between(random, 1.0, 7.0));
        normal = random_unit(random);
      }
      const std::uint32_t half = two && whole ? 4 : 0;
      fill_group(scene, tile, g, g == 0 ? first : uvec2(4, 0), g == 0 ? last - uvec2(half, 0) : uvec2(7), point, normal,
                 rise);
      std::vector<ClassifyPixel>& group = scene.tiles[tile].groups[g];
      if (random() % 3 == 0) bend_normals(group, random() % 2 == 0 ? 0.0 : 0.02, 0.1, random);
      if (random() % 16 == 0)
        for (ClassifyPixel& pixel : group) pixel.subsurface = true;
    }
    if (scene.tiles[tile].groups[0].empty()) scene.tiles[tile].groups[1].clear();
  }
}

/// Rectangles between the lights and the receiver, near the receiver, and behind it.
RayScene random_casters(const ClassifyScene& scene, const dvec3& normal, std::mt19937& random) {
  std::vector<RayScene> casters;
  if (random() % 5 != 0) casters.push_back(plane(kClassifyMiddle, normal));
  if (random() % 2 == 0) {
    const dvec3 way = kClassifyMiddle - scene.lights[1].vector;
    casters.push_back(rectangle(kClassifyMiddle - way * between(random, 0.2, 0.7), way,
                                glm::dvec2(between(random, 0.5, 2.0), between(random, 0.5, 2.0))));
  }
  const auto count = random() % 6;
  for (std::uint32_t i = 0; i < count; ++i) {
    const ClassifyLight& light = scene.lights[random() % 3];
    const dvec3 aside = dvec3(between(random, -1.5, 1.5), between(random, -1.2, 1.2), between(random, -0.5, 0.5));
    const dvec3 target = kClassifyMiddle + aside - normal * glm::dot(aside, normal);
    const dvec3 way = light.kind == CastKind::sun ? light.vector * 2.0 : target - light.vector;
    const auto where = random() % 4;
    const double share = where == 0   ? between(random, 0.1, 0.5)
                         : where == 1 ? between(random, 0.5, 0.95)
                         : where == 2 ? 1.0 - between(random, 0.002, 0.03)
                                      : between(random, 1.02, 1.5);
    const double most = where > 1 ? 0.3 : random() % 2 == 0 ? 2.0 : 0.4;
    const bool parallel = where == 2 || random() % 3 == 0;
    casters.push_back(rectangle(target - way * (1.0 - share), parallel ? normal : random_unit(random),
                                glm::dvec2(between(random, 0.02, most), between(random, 0.02, most))));
  }
  return nearest_of(casters);
}

ClassifyScene random_classify_scene(std::uint32_t seed) {
  std::mt19937 random(seed * 7919u + 11u);
  ClassifyScene scene = empty_classify_scene(seed % 4 == 3 ? 128 : 64);
  constexpr double kWidths[] = {0.0, 0.02, 0.1, 0.4};
  const double width = kWidths[random() % 4];
  dvec3 normal(0.0), ways[3];
  do {
    normal = random_unit(random);
    for (int i = 0; i < 3; ++i)
      ways[i] = i == 1 ? direction_to(static_cast<CubePart>(seed % 3), random) : random_unit(random);
  } while (normal.z < 0.6 || std::any_of(ways, ways + 3, [&](const dvec3& v) { return glm::dot(v, normal) > -0.3; }));
  scene.lights = {
      classify_spot(kClassifyMiddle - ways[0] * between(random, 1.0, 3.0), ways[0], between(random, 0.5, 1.4), width),
      classify_cube(kClassifyMiddle - ways[1] * between(random, 0.5, 2.5), width),
      classify_sun(ways[2], kClassifyMiddle, {between(random, 0.5, 1.5), between(random, 1.6, 2.5)}, 0.3 * width,
                   scene.face_size)};
  place_tiles(scene, normal, random);
  draw_classify_maps(scene, random_casters(scene, normal, random));
  return scene;
}

// Hard case: selftest.classification
TEST_F(ClassifyKernels, contradict_neither_a_search_of_the_maps_nor_the_filter) {
  const ClassifyOptions options;
  std::array<ClassifyYield, kClassifyLights> yields{};
  ShadowMaps maps(device(), 512);
  const int scenes = scaled(16);
  for (int seed = 0; seed < scenes; ++seed) {
    const ClassifyScene scene = random_classify_scene(static_cast<std::uint32_t>(seed));
    const Classified c = classify(scene, options);
    expect_agreement(scene, c, options.pair_capacity);
    expect_as_searched(scene, c, 13);
    expect_as_filtered(scene, c, maps, options.filter);
    expect_in_face(scene, c);
    if (HasFailure()) FAIL() << "seed " << seed;
    add_yields(c, scene, yields);
  }
  for (std::size_t light = 0; light < kClassifyLights; ++light) {
    const auto [lit, unlit, open] = yields[light];
    const std::uint32_t all = lit + unlit + open;
    EXPECT_GE(lit * 4, all) << kClassifyLightNames[light];
    EXPECT_GE(unlit * 30, all) << kClassifyLightNames[light];
    EXPECT_GE(open * 20, all) << kClassifyLightNames[light];
  }
}

// Kernels of a fixed width have no cone, so planes decide more often.
TEST_F(ClassifyKernels, do_not_contradict_a_filter_of_fixed_width) {
  ClassifyOptions options;
  options.filter = {.filter = 1, .levels = 255};
  std::array<ClassifyYield, kClassifyLights> yields{};
  ShadowMaps maps(device(), 512);
  const int scenes = scaled(6);
  for (int seed = 0; seed < scenes; ++seed) {
    ClassifyScene scene = random_classify_scene(static_cast<std::uint32_t>(seed));
    std::mt19937 random(static_cast<std::uint32_t>(seed));
    for (ClassifyTile& tile : scene.tiles)
      for (auto& group : tile.groups) bend_normals(group, random() % 2 == 0 ? 0.0 : 0.02, 0.0, random);
    const Classified c = classify(scene, options);
    expect_agreement(scene, c, options.pair_capacity);
    expect_as_filtered(scene, c, maps, options.filter);
    expect_in_face(scene, c);
    if (HasFailure()) FAIL() << "seed " << seed;
    add_yields(c, scene, yields);
  }
  for (const auto& [lit, unlit, open] : yields) {
    EXPECT_GE(lit * 15, lit + unlit + open);
  }
}

TEST_F(ClassifyKernels, make_pairs_of_all_candidates_when_classification_is_off) {
  const ClassifyScene scene = random_classify_scene(4);
  ClassifyOptions options;
  options.classify = 0;
  const Classified c = classify(scene, options);
  expect_agreement(scene, c, options.pair_capacity);
  const auto with_pixels = std::count_if(scene.tiles.begin(), scene.tiles.end(),
                                         [](const ClassifyTile& tile) { return !tile.groups[0].empty(); });
  EXPECT_EQ(c.counters[0].pairs, kClassifyLights * with_pixels);
  EXPECT_EQ(c.commands[0].pairs[GLOAM_PAIRS_IN_FACE].w, 0u);
  EXPECT_EQ(c.commands[0].pairs[GLOAM_PAIRS_CROSSING].w, 2 * with_pixels) << "those of the spot and of the cube";
}

// Hard case: shadows.full_slots
TEST_F(ClassifyKernels, find_no_room_for_a_pair_in_a_full_buffer) {
  const ClassifyScene scene = random_classify_scene(4);
  const Classified all = classify(scene);
  const std::uint32_t pairs = all.counters[0].pairs;
  ASSERT_GE(pairs, 8u);
  for (const std::uint32_t capacity : {0u, 1u, pairs / 2, pairs - 1, pairs}) {
    ClassifyOptions options;
    options.pair_capacity = capacity;
    const Classified c = classify(scene, options);
    expect_agreement(scene, c, capacity);
    EXPECT_EQ(c.counters[0].pairs, pairs);
    EXPECT_EQ(std::count_if(c.entries.begin(), c.entries.end(), [](auto e) { return e >> 10 == GLOAM_NO_ROOM; }),
              pairs - capacity);
    EXPECT_EQ(c.counters[0].lit_at_once, all.counters[0].lit_at_once);
    EXPECT_EQ(c.counters[0].unlit_at_once, all.counters[0].unlit_at_once);
    if (HasFailure()) FAIL() << "capacity " << capacity;
  }
}

// Group one is on the receiver, in front of a wall or behind it. Group two is behind the wall, in front of it, or not
// illuminated, because it faces away from the lights.
TEST_F(ClassifyKernels, decide_a_tile_whose_groups_agree_or_are_not_asked) {
  enum Place { front, behind, away };
  SimpleScene s = simple_scene(CubePart::face_middle, 5, 0.0);
  s.from_light = dvec3(0.0, 0.0, -1.0);
  const dvec3 normal(0.0, 0.0, 1.0), middle = kClassifyMiddle;
  s.scene.lights = {classify_spot(middle + dvec3(0.1, 0.05, 3.0), s.from_light, 0.9, 0.0),
                    classify_cube(middle + dvec3(0.1, 0.05, 3.0), 0.0),
                    classify_sun(s.from_light, middle, {1.0, 2.0}, 0.0, 64)};
  draw_classify_maps(s.scene, nearest_of({plane(middle, normal), rectangle(middle + normal, normal, glm::dvec2(2.0))}));
  constexpr std::uint32_t kTile = 4 * 12 + 6;
  const auto slots = [&](Place one, Place two) {
    for (std::size_t g = 0; g < 2; ++g) {
      const Place place = g == 0 ? one : two;
      fill_group(s.scene, kTile, g, uvec2(4 * g, 0), uvec2(4 * g + 3, 7),
                 place == front ? middle + 1.5 * normal : middle, place == away ? -normal : normal);
    }
    const Classified c = classify(s.scene);
    expect_agreement(s.scene, c, ClassifyOptions().pair_capacity);
    return std::array{c.slot(kTile, 0), c.slot(kTile, 1), c.slot(kTile, 2)};
  };
  const auto each = [](std::uint32_t slot) { return std::array{slot, slot, slot}; };
  EXPECT_EQ(slots(front, front), each(GLOAM_ALL_LIT));
  EXPECT_EQ(slots(behind, behind), each(GLOAM_ALL_UNLIT));
  EXPECT_EQ(slots(front, behind), each(kTile));
  EXPECT_EQ(slots(behind, front), each(kTile));
  EXPECT_EQ(slots(front, away), each(GLOAM_ALL_LIT));
  EXPECT_EQ(slots(away, front), each(GLOAM_ALL_LIT));
  EXPECT_EQ(slots(behind, away), each(GLOAM_ALL_UNLIT));
  EXPECT_EQ(slots(away, behind), each(GLOAM_ALL_UNLIT));
  EXPECT_EQ(slots(away, away), each(GLOAM_ALL_UNLIT));
}

// A pixel beside the border of a cube face, and a blocker that only the neighbouring face holds: in front of the light,
// between a wide emitter and the pixel, or behind the light, where no pixel can meet it.
TEST_F(ClassifyKernels, find_blockers_in_the_neighbouring_face) {
  constexpr std::uint32_t kTile = 4 * 12 + 6;
  const glm::dmat3 cube = cube_axes();
  std::uint32_t tested = 0;
  for (int i = 0; i < 24; ++i) {
    const dvec3 ahead = (i % 2 == 0 ? 1.0 : -1.0) * cube[i / 2 % 3];
    const dvec3 aside = (i / 6 % 2 == 0 ? 1.0 : -1.0) * cube[(i / 2 + 1 + i / 12) % 3];
    const dvec3 from_light = 2.0 * ahead + 1.9 * aside, toward = -glm::normalize(from_light);
    const dvec3 normal = glm::normalize(toward + dvec3(0.0, 0.0, 0.5));
    if (normal.z < 0.3) continue;
    for (const bool in_front : {true, false}) {
      SimpleScene s = simple_scene(CubePart::face_middle, 5, 0.0, 128);
      for (ClassifyTile& tile : s.scene.tiles) tile.groups[0].clear();
      fill_group(s.scene, kTile, 0, uvec2(0), uvec2(0), kClassifyMiddle, normal);
      const std::vector<ClassifyPixel>& pixels = s.scene.tiles[kTile].groups[0];
      ASSERT_FALSE(pixels.empty());
      const dvec3 position = pixels[0].position - from_light;
      s.scene.lights[1] = classify_cube(position, in_front ? 1.5 : 0.05);
      // Beyond the rim, which ends at 1.125 times the distance along the axis.
      const dvec3 blocker = position + (in_front ? 0.8 : -0.8) * ahead + 0.98 * aside;
      draw_classify_maps(s.scene,
                         nearest_of({plane(pixels[0].position, normal), rectangle(blocker, ahead, glm::dvec2(0.07))}));
      const std::uint32_t slot = classify(s.scene).slot(kTile, 1);
      const ClassifyOracle oracle(s.scene.lights[1], 128, kClassifyBiasM);
      EXPECT_EQ(oracle.is_partly_hidden(pixels[0]), in_front) << "direction " << i;
      EXPECT_EQ(slot, in_front ? kTile : GLOAM_ALL_LIT) << "direction " << i;
      ++tested;
    }
  }
  EXPECT_GE(tested, 16u);
}

}  // namespace
}  // namespace gloam::test

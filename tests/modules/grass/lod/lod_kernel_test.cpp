// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "modules/grass/lod/detail.h"
#include "shaders/grass/shaders.h"
#include "shaders/grass_test/shaders.h"
#include "tests/modules/grass/support/lod_field.h"
#include "tests/support/kernel.h"
#include "tests/support/scale.h"

namespace gloam::test {
namespace {

/// Input of one thread of lod_widths.comp.
struct WidthQuery {
  float width_m = 0.006f;
  float rank = 0.0f;
  float distance_m = 1.0f;
  float max_distance_m = 1000.0f;
};

class GrassDetail : public KernelTest {
 protected:
  /// Share and factor of the width of each blade.
  [[nodiscard]] static std::vector<vec2> widths(const shaders::GrassLod& lod, std::vector<WidthQuery> queries) {
    const std::size_t count = queries.size();
    queries.resize((count + 63) / 64 * 64);
    Kernel kernel(device(), shaders::grass_test::lod_widths_comp);
    kernel.input(0, std::vector<shaders::GrassLod>{lod});
    kernel.input(1, queries);
    kernel.output(2, queries.size() * sizeof(vec2));
    kernel.run(static_cast<std::uint32_t>(queries.size() / 64));
    std::vector<vec2> found = kernel.read<vec2>(2);
    found.resize(count);
    return found;
  }
  [[nodiscard]] static std::vector<std::uint32_t> keys(const LodField& field, const shaders::GrassLod& lod) {
    Kernel kernel(device(), shaders::grass::keys_comp);
    kernel.input(0, std::vector<shaders::GrassLod>{lod});
    kernel.input(1, field.patches);
    kernel.input(2, field.blades);
    kernel.output(3, field.patches.size() * GLOAM_GRASS_PATCH_BLADES);
    kernel.run(static_cast<std::uint32_t>(field.patches.size()));
    std::vector<std::uint32_t> found;
    for (const std::uint32_t word : kernel.read<std::uint32_t>(3))
      for (std::uint32_t i = 0; i < 4; ++i) found.push_back(word >> (8 * i) & 0xFFu);
    return found;
  }
  struct Arguments {
    shaders::GrassDraws draws{};
    shaders::GrassDispatch dispatch{};
    shaders::GrassCasting casting{};
  };
  [[nodiscard]] static Arguments arguments(const shaders::GrassLod& lod, const std::vector<std::uint32_t>& bins) {
    Kernel kernel(device(), shaders::grass::live_comp);
    kernel.input(0, std::vector<shaders::GrassLod>{lod});
    kernel.input(1, bins);
    kernel.output(2, sizeof(shaders::GrassDraws));
    kernel.output(3, sizeof(shaders::GrassDispatch));
    kernel.output(4, sizeof(shaders::GrassCasting));
    kernel.run(1);
    return {kernel.read<shaders::GrassDraws>(2)[0], kernel.read<shaders::GrassDispatch>(3)[0],
            kernel.read<shaders::GrassCasting>(4)[0]};
  }
  struct Listed {
    std::vector<shaders::GrassMaster> masters;
    shaders::GrassDispatch dispatch{};
    std::vector<std::uint32_t> stamps;
  };
  [[nodiscard]] static Listed listed(const LodField& field, const shaders::GrassSteps& steps,
                                     const std::vector<std::uint32_t>& blades, std::uint32_t live,
                                     const std::vector<std::uint32_t>& stamps, std::uint32_t group_masters = 4,
                                     std::uint32_t most_masters = ~0u, float stride_px = 0.0f) {
    shaders::GrassLod lod{};
    lod.most_masters = most_masters;
    lod.stride_px = stride_px;
    lod.pixel_m = 0.0026f;
    shaders::GrassDraws draws{};
    draws.live = live;
    Kernel kernel(device(), shaders::grass::masters_comp, {{"kGroupMasters", group_masters}});
    kernel.input(0, std::vector<shaders::GrassSteps>{steps});
    kernel.input(1, field.patches);
    kernel.input(2, field.blades);
    kernel.input(3, blades);
    kernel.input(4, std::vector<shaders::GrassDraws>{draws});
    kernel.in_out(5, stamps);
    kernel.output(6, stamps.size() * sizeof(shaders::GrassMaster));
    kernel.in_out(7, std::vector<shaders::GrassDispatch>{{0, uvec3(0, 1, 1)}});
    kernel.input(8, std::vector<shaders::GrassLod>{lod});
    kernel.run(std::max((live + 63) / 64, 1u));
    Listed found;
    found.dispatch = kernel.read<shaders::GrassDispatch>(7)[0];
    found.masters = kernel.read<shaders::GrassMaster>(6);
    found.masters.resize(std::min<std::size_t>(found.dispatch.masters, found.masters.size()));
    found.stamps = kernel.read<std::uint32_t>(5);
    return found;
  }
};

TEST_F(GrassDetail, the_mean_width_over_all_ranks_is_1_at_every_distance) {
  constexpr int kRanks = 2048;
  const int distances = scaled(40);
  for (const float pixels : {0.0f, 0.5f, 1.0f, 3.0f}) {
    shaders::GrassLod lod = lod_of(camera_at(dvec3(0.0), dvec3(0.0, 0.0, -1.0)), 100.0f);
    lod.width_px = pixels;
    std::vector<WidthQuery> queries;
    for (int d = 0; d < distances; ++d)
      for (int r = 0; r < kRanks; ++r)
        queries.push_back({0.006f, (static_cast<float>(r) + 0.5f) / kRanks,
                           0.05f * std::pow(1800.0f, static_cast<float>(d) / static_cast<float>(distances)), 1000.0f});
    const std::vector<vec2> found = widths(lod, queries);
    for (int d = 0; d < distances; ++d) {
      double sum = 0.0, kept = 0.0;
      for (int r = 0; r < kRanks; ++r) {
        const vec2 one = found[static_cast<std::size_t>(d * kRanks + r)];
        ASSERT_TRUE(std::isfinite(one.y) && one.y >= 0.0f);
        sum += static_cast<double>(one.y), kept += one.y > 0.0f ? 1.0 : 0.0;
      }
      const std::size_t first = static_cast<std::size_t>(d) * kRanks;
      const double share = static_cast<double>(found[first].x);
      EXPECT_NEAR(sum / kRanks, 1.0, 2e-3) << queries[first].distance_m << " m, " << pixels << " pixels";
      EXPECT_LE(kept / kRanks, std::min(1.0, 1.26 * share)) << queries[first].distance_m << " m";
      EXPECT_TRUE(pixels > 0.0f || share == 1.0);
    }
  }
}

TEST_F(GrassDetail, widths_change_little_between_neighbouring_distances) {
  // A blade that fades narrows to 0 while the share falls by a fifth, so a step of 0.1 % of the distance changes a
  // width by at most 0.01 of the widest.
  shaders::GrassLod lod = lod_of(camera_at(dvec3(0.0), dvec3(0.0, 0.0, -1.0)), 40.0f);
  lod.width_px = 1.0f;
  for (const float rank : {0.0f, 0.06f, 0.08f, 0.3f, 0.5f, 0.79f, 0.81f, 0.99f, 1.0f}) {
    std::vector<WidthQuery> queries;
    for (float distance = 0.3f; distance < 41.0f; distance *= 1.001f)
      queries.push_back({0.006f, rank, distance, 40.0f});
    const std::vector<vec2> found = widths(lod, queries);
    for (std::size_t i = 1; i < found.size(); ++i) {
      const float widest = 1.0f / found[i].x;
      EXPECT_LT(std::abs(found[i].y - found[i - 1].y), 0.015f * widest)
          << "rank " << rank << ", " << queries[i].distance_m << " m";
    }
    EXPECT_EQ(found.back().y, 0.0f) << "beyond the range a blade has no width";
  }
}

TEST_F(GrassDetail, at_the_end_of_the_range_all_blades_narrow_to_nothing) {
  shaders::GrassLod lod = lod_of(camera_at(dvec3(0.0), dvec3(0.0, 0.0, -1.0)), 40.0f);
  lod.width_px = 0.0f;
  const std::vector<vec2> found =
      widths(lod, {{0.006f, 0.0f, 30.0f, 40.0f}, {0.006f, 0.0f, 39.0f, 40.0f}, {0.006f, 0.0f, 40.0f, 40.0f}});
  EXPECT_EQ(found[0].y, 1.0f);
  EXPECT_GT(found[1].y, 0.0f);
  EXPECT_LT(found[1].y, 0.5f);
  EXPECT_EQ(found[2].y, 0.0f);
}

TEST_F(GrassDetail, keys_are_the_distances_of_the_blades_that_show) {
  const int rounds = std::max(scaled(12), 12);  // few cameras may see few blades
  std::size_t compared = 0, drawn = 0, culled = 0;
  for (int round = 0; round < rounds; ++round) {
    LodField field = LodField::random(24, static_cast<std::uint32_t>(round));
    const RenderView view = field.camera(static_cast<std::uint32_t>(round));
    shaders::GrassLod lod = lod_of(view, field.range_m);
    lod.width_px = round % 3 == 0 ? 0.0f : 1.0f;
    lod.threshold = round % 4 == 3 ? 90u : 254u;
    lod.cast_m = round % 2 == 0 ? 0.0f : 3.0f;
    const std::vector<std::uint32_t> found = keys(field, lod);
    ASSERT_EQ(found.size(), field.patches.size() * GLOAM_GRASS_PATCH_BLADES);
    for (std::uint32_t i = 0; i < found.size(); ++i) {
      const ExpectedKey expected = expected_key(field, view, lod, i);
      if (expected.doubtful) continue;
      ++compared;
      ASSERT_EQ(found[i], expected.key) << "round " << round << ", blade " << i;
      (found[i] == GLOAM_GRASS_CULLED ? culled : drawn) += 1;
    }
  }
  EXPECT_GT(compared, static_cast<std::size_t>(rounds) * 5000);
  EXPECT_GT(std::min(drawn, culled), static_cast<std::size_t>(rounds) * 200);
}

// Hard case: grass.all_culled, grass.threshold_0, grass.threshold_most
TEST_F(GrassDetail, live_blades_are_those_up_to_the_threshold_and_the_classes_divide_them) {
  std::mt19937 random(5);
  const int rounds = scaled(150);
  for (int round = 0; round < rounds; ++round) {
    std::vector<std::uint32_t> bins = {0};
    for (int key = 0; key < 256; ++key)
      bins.push_back(bins.back() + (round == 0 ? 0 : static_cast<std::uint32_t>(random() % (round % 2 == 0 ? 2 : 90))));
    shaders::GrassLod lod = lod_of(camera_at(dvec3(0.0), dvec3(0.0, 0.0, -1.0)), 40.0f);
    lod.threshold = round % 5 == 0 ? 254 : round % 5 == 1 ? 0 : static_cast<std::uint32_t>(random() % 255);
    std::uint32_t ends[3];
    for (std::uint32_t& end : ends) end = static_cast<std::uint32_t>(random() % 255);
    std::ranges::sort(ends);
    lod.class_keys = uvec4(ends[0], ends[1], ends[2], 254);
    lod.cast_key = round % 3 == 0 ? GLOAM_GRASS_CULLED : static_cast<std::uint32_t>(random() % 255);
    const auto [draws, dispatch, cast] = arguments(lod, bins);
    const std::uint32_t live = bins[lod.threshold + 1];
    ASSERT_EQ(draws.live, live);
    EXPECT_EQ(draws.blade_groups, uvec3((live + 63) / 64, 1, 1));
    std::uint32_t first = 0;
    for (int c = 0; c < GLOAM_GRASS_CLASSES; ++c) {
      EXPECT_EQ(draws.class_first[c], first);
      first += draws.class_count[c];
      EXPECT_EQ(first, std::min(live, bins[lod.class_keys[c] + 1])) << "class " << c;
      const shaders::GrassDraw& draw = draws.draws[c];
      EXPECT_EQ(draw.indices, 6 * lod.class_segments[c] * GLOAM_GRASS_DRAW_BLADES);
      EXPECT_EQ(draw.instances, (draws.class_count[c] + GLOAM_GRASS_DRAW_BLADES - 1) / GLOAM_GRASS_DRAW_BLADES);
      EXPECT_EQ(draw.first_index, lod.class_indices[c]);
      EXPECT_EQ(draw.vertex_offset, 0u);
      EXPECT_EQ(draw.first_instance, 0u);
    }
    EXPECT_EQ(first, live);
    const std::uint32_t casting = lod.cast_key == GLOAM_GRASS_CULLED ? 0 : std::min(live, bins[lod.cast_key + 1]);
    EXPECT_EQ(draws.cast_count, casting);
    EXPECT_EQ(cast.count, 0u);  // no blade is listed yet
    EXPECT_EQ(cast.draw.instances, 0u);
    EXPECT_EQ(cast.draw.indices, 6 * lod.class_segments[GLOAM_GRASS_CAST_CLASS] * GLOAM_GRASS_DRAW_BLADES);
    EXPECT_EQ(dispatch.masters, 0u);
    EXPECT_EQ(dispatch.groups, uvec3(0, 1, 1));
  }
}

TEST_F(GrassDetail, each_master_of_a_live_blade_is_listed_once_and_no_other) {
  const int rounds = scaled(12);
  for (int round = 0; round < rounds; ++round) {
    std::mt19937 random(static_cast<std::uint32_t>(round));
    const LodField field = LodField::random(20, static_cast<std::uint32_t>(round));
    std::vector<std::uint32_t> blades;
    for (std::uint32_t p = 0; p < field.patches.size(); ++p)
      for (std::uint32_t i = 0; i < field.patches[p].blades; ++i) blades.push_back(p * GLOAM_GRASS_PATCH_BLADES + i);
    std::ranges::shuffle(blades, random);
    const auto live = round == 0 ? 0 : static_cast<std::uint32_t>(random() % (blades.size() + 1));
    const shaders::GrassSteps steps{.step_s = 1.0f / 120.0f, .now = 1000, .frame_steps = 3, .iterations = 3};
    std::vector<std::uint32_t> stamps(field.places);
    for (std::uint32_t& stamp : stamps) {
      const std::uint32_t choices[] = {GLOAM_GRASS_NO_STEP, 1000, 999, 997, 500, 0};
      stamp = choices[random() % std::size(choices)];
    }
    std::map<std::uint32_t, std::uint32_t> wanted;  // row << 8 | index → steps
    std::vector<std::uint32_t> after = stamps;
    for (std::uint32_t i = 0; i < live; ++i) {
      const std::uint32_t row = blades[i] / GLOAM_GRASS_PATCH_BLADES;
      const shaders::GrassPatchRow& patch = field.patches[row];
      const std::uint32_t master =
          field.blades[patch.first_blade + blades[i] % GLOAM_GRASS_PATCH_BLADES].kind >> 16 & 0xFFu;
      const std::uint32_t reached = stamps[patch.first_place + master];
      after[patch.first_place + master] = 1000;
      if (reached == 1000) continue;
      wanted[row << 8 | master] =
          reached == GLOAM_GRASS_NO_STEP ? GLOAM_GRASS_NO_STEP : std::min(1000 - reached, steps.frame_steps);
    }
    for (const std::uint32_t group : {2u, 4u, 8u}) {
      const Listed found = listed(field, steps, blades, live, stamps, group);
      ASSERT_EQ(found.dispatch.masters, wanted.size());
      EXPECT_EQ(found.dispatch.groups, uvec3((wanted.size() + group - 1) / group, 1, 1));
      std::map<std::uint32_t, std::uint32_t> got;
      for (const shaders::GrassMaster& master : found.masters)
        EXPECT_TRUE(got.emplace(master.blade, master.steps).second) << "master " << master.blade << " is listed twice";
      EXPECT_EQ(got, wanted);
      EXPECT_EQ(found.stamps, after);
      // A later view of the frame finds them simulated.
      EXPECT_EQ(listed(field, steps, blades, live, found.stamps, group).dispatch.masters, 0u);
    }
  }
}

TEST_F(GrassDetail, masters_of_small_blades_run_several_steps_at_once_and_lose_none) {
  LodField field = LodField::random(20, 5);
  field.patches[0].colliders = 1;
  std::vector<std::uint32_t> blades;
  for (std::uint32_t p = 0; p < field.patches.size(); ++p)
    for (std::uint32_t i = 0; i < field.patches[p].blades; ++i) blades.push_back(p * GLOAM_GRASS_PATCH_BLADES + i);
  const auto live = static_cast<std::uint32_t>(blades.size());
  for (const std::uint32_t frame_steps : {1u, 2u, 3u, 8u}) {
    std::vector<std::uint32_t> stamps(field.places, 16);
    std::map<std::uint32_t, std::uint32_t> steps_of, stride_of;
    std::uint32_t now = 16;
    for (std::uint32_t frame = 0; frame < 24; ++frame) {
      now += frame_steps;
      const shaders::GrassSteps steps{.step_s = 1.0f / 120.0f, .now = now, .frame_steps = frame_steps, .iterations = 3};
      const Listed found = listed(field, steps, blades, live, stamps, 4, ~0u, 24.0f);
      stamps = found.stamps;
      for (const shaders::GrassMaster& master : found.masters) {
        EXPECT_EQ(master.steps % master.stride, 0u);
        if (master.blade >> 8 == 0) {
          EXPECT_EQ(master.stride, 1u) << "near a collider";
        }
        steps_of[master.blade] += master.steps;
        stride_of[master.blade] = master.stride;
      }
    }
    std::map<std::uint32_t, std::size_t> strides;
    for (const auto& [blade, count] : steps_of) {
      ++strides[stride_of[blade]];
      EXPECT_LE(now - 16 - count, stride_of[blade] - 1) << "stride " << stride_of[blade];
    }
    EXPECT_GT(strides[1], 0u);
    EXPECT_GT(strides[2] + strides[4], steps_of.size() / 4) << frame_steps;
  }
}

TEST_F(GrassDetail, masters_beyond_the_room_of_the_dispatch_wait_for_the_next_frame) {
  const LodField field = LodField::random(12, 3);
  std::vector<std::uint32_t> blades;
  for (std::uint32_t p = 0; p < field.patches.size(); ++p)
    for (std::uint32_t i = 0; i < field.patches[p].blades; ++i) blades.push_back(p * GLOAM_GRASS_PATCH_BLADES + i);
  const auto live = static_cast<std::uint32_t>(blades.size());
  const shaders::GrassSteps steps{.step_s = 1.0f / 120.0f, .now = 50, .frame_steps = 2, .iterations = 3};
  const std::vector<std::uint32_t> stamps(field.places, 48);
  const std::size_t all = listed(field, steps, blades, live, stamps).masters.size();
  constexpr std::uint32_t kRoom = 8;
  const Listed first = listed(field, steps, blades, live, stamps, 4, kRoom);
  EXPECT_GE(first.dispatch.masters, all);  // what the CPU makes room for
  EXPECT_EQ(first.dispatch.groups.x, kRoom / 4);
  EXPECT_EQ(std::ranges::count(first.stamps, 50u), kRoom);
  const Listed rest = listed(field, steps, blades, live, first.stamps);
  EXPECT_EQ(rest.dispatch.masters, all - kRoom);
}

TEST(GrassBladeIndices, draw_two_triangles_for_each_segment_of_32_blades) {
  const std::vector<std::uint32_t> indices = blade_indices();
  const shaders::GrassLod lod = lod_of(camera_at(dvec3(0.0), dvec3(0.0, 0.0, -1.0)), 40.0f);
  std::size_t end = 0;
  for (int c = 0; c < GLOAM_GRASS_CLASSES; ++c) {
    const std::uint32_t segments = lod.class_segments[c];
    ASSERT_EQ(segments, kClassSegments[static_cast<std::size_t>(c)]);
    EXPECT_EQ(15 % segments, 0u);
    ASSERT_EQ(lod.class_indices[c], end);
    const std::size_t first = end;
    end += std::size_t{6} * segments * GLOAM_GRASS_DRAW_BLADES;
    ASSERT_LE(end, indices.size());
    std::set<std::set<std::uint32_t>> triangles;
    for (std::size_t i = first; i < end; i += 3) {
      const std::set<std::uint32_t> corners(indices.begin() + static_cast<std::ptrdiff_t>(i),
                                            indices.begin() + static_cast<std::ptrdiff_t>(i + 3));
      ASSERT_EQ(corners.size(), 3u);
      EXPECT_TRUE(triangles.insert(corners).second);
      const std::uint32_t per_blade = 2 * (segments + 1), blade = *corners.begin() / per_blade;
      EXPECT_LT(blade, GLOAM_GRASS_DRAW_BLADES);
      EXPECT_EQ(*corners.rbegin() / per_blade, blade) << "a triangle joins two blades";
      EXPECT_EQ(*corners.rbegin() / 2 - *corners.begin() / 2, 1u) << "a triangle has corners at two neighbouring knots";
    }
    EXPECT_EQ(triangles.size(), std::size_t{2} * segments * GLOAM_GRASS_DRAW_BLADES);
  }
  EXPECT_EQ(end, indices.size());
}

TEST(GrassDetailClasses, need_more_segments_nearer_and_full_segments_everywhere_if_so_chosen) {
  const RenderView view = camera_at(dvec3(0.0), dvec3(0.0, 0.0, -1.0));
  const shaders::GrassLod lod = lod_of(view, 40.0f);
  for (int c = 1; c < GLOAM_GRASS_CLASSES; ++c) {
    EXPECT_GE(lod.class_keys[c], lod.class_keys[c - 1]);
    EXPECT_LT(lod.class_segments[c], lod.class_segments[c - 1]);
  }
  EXPECT_EQ(lod.class_keys[GLOAM_GRASS_CLASSES - 1], 254u);
  GrassKnobs knobs;
  knobs.all_segments = true;
  EXPECT_EQ(grass_lod(view, knobs, {40.0f, 0.4f}).class_keys[0], 254u);
}

}  // namespace
}  // namespace gloam::test

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/grass/growth/patches.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "modules/grass/field/mesh_surface.h"
#include "tests/jobs/executors.h"
#include "tests/modules/grass/growth/lawns.h"

namespace gloam {
namespace {

constexpr std::uint32_t kSlots = GLOAM_GRASS_PATCH_BLADES;

struct Patches {
  GrowthSurface surface;
  std::vector<ScatteredRoot> roots;
  std::vector<BladeType> types = builtin_blade_types();
  PatchSource source;
  std::vector<GrassPatch> patches;
  std::vector<GrassBlade> blades;

  Patches(std::uint32_t count, std::uint32_t slaves, const Mesh& mesh = test::lawn(1, 20.0f)) {
    const auto jobs = make_serial_executor();
    surface = growth_surface(mesh, dmat4(1.0));
    roots = scatter_roots(surface, count, 1, *jobs);
    source.entity = Entity{7, 1};
    source.types = types;
    source.slaves_per_master = slaves;
    append(*jobs);
  }
  void append(JobExecutor& jobs) { append_patches(surface, roots, source, jobs, patches, blades); }

  [[nodiscard]] std::span<const GrassBlade> of(const GrassPatch& patch) const {
    return std::span(blades).subspan(std::size_t{patch.index} * kSlots, patch.blades);
  }
  /// All blades, without the empty slots.
  [[nodiscard]] std::vector<GrassBlade> all() const {
    std::vector<GrassBlade> found;
    for (const GrassPatch& patch : patches) found.insert(found.end(), of(patch).begin(), of(patch).end());
    return found;
  }
};

// Hard case: grass.blades_0
TEST(Patches, any_count_of_blades_is_grouped_with_masters_first_and_empty_slots_last) {
  for (const std::uint32_t slaves : {0u, 1u, 2u, 4u, 8u, 16u}) {
    for (const std::uint32_t count : {0u, 1u, 2u, 3u, 4u, 5u, 6u, 17u, 63u, 65u, 255u, 256u, 257u, 511u, 1000u}) {
      const Patches p(count, slaves);
      ASSERT_EQ(p.patches.size(), (count + 255) / 256);
      ASSERT_EQ(p.blades.size(), p.patches.size() * kSlots);
      std::uint32_t blades = 0;
      for (const GrassPatch& patch : p.patches) {
        blades += patch.blades;
        EXPECT_EQ(patch.masters, (patch.blades + slaves) / (slaves + 1));
        EXPECT_EQ(patch.surface, (Entity{7, 1}));
        EXPECT_EQ(&patch - p.patches.data(), patch.index);
        std::map<std::uint32_t, std::uint32_t> followers;
        for (std::uint32_t s = 0; s < kSlots; ++s) {
          const GrassBlade& blade = p.blades[patch.index * kSlots + s];
          ASSERT_EQ(blade.slot, patch.index * kSlots + s);
          ASSERT_EQ(blade.length_m > 0.0f, s < patch.blades);
          if (s < patch.masters || s >= patch.blades) {
            EXPECT_EQ(blade.master, blade.slot);
            continue;
          }
          EXPECT_EQ(blade.master / kSlots, patch.index);
          EXPECT_LT(blade.master % kSlots, patch.masters);
          ++followers[blade.master];
        }
        for (const auto& [master, number] : followers) EXPECT_LE(number, slaves);
      }
      EXPECT_EQ(blades, count);
    }
  }
}

TEST(Patches, every_root_has_one_blade_at_its_place_on_its_ground) {
  const Patches p(3000, 4, test::lawn(30, 20.0f, &test::hills));
  std::vector<dvec3> expected = test::positions_of(p.surface, p.roots);
  std::vector<dvec3> found;
  for (const GrassPatch& patch : p.patches) {
    Aabb box;
    float reach = 0.0f;
    for (const GrassBlade& blade : p.of(patch)) {
      found.push_back(patch.origin + dvec3(blade.root_m));
      box.grow(blade.root_m);
      reach = std::max(reach, blade.length_m);
      EXPECT_NEAR(glm::length(blade.ground_normal), 1.0f, 1e-5f);
      EXPECT_GE(blade.ground_normal.y, kGrowthCosine);
    }
    EXPECT_EQ(box.min, patch.roots.min);
    EXPECT_EQ(box.max, patch.roots.max);
    EXPECT_EQ(reach, patch.reach_m);
    EXPECT_LT(glm::length(box.center()), 1e-5f);
  }
  const auto by_place = [](const dvec3& a, const dvec3& b) { return a.x != b.x ? a.x < b.x : a.z < b.z; };
  std::ranges::sort(expected, by_place);
  std::ranges::sort(found, by_place);
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_LT(glm::length(found[i] - expected[i]), 1e-5);
}

TEST(Patches, boxes_are_compact) {
  for (const std::uint32_t count : {16u * 256u, 20000u, 30000u}) {
    const Patches p(count, 4);
    double area = 0.0;
    double edge = 0.0;
    for (const GrassPatch& patch : p.patches) {
      const vec3 size = patch.roots.max - patch.roots.min;
      area += double{size.x} * size.z;
      edge += double{size.x} + size.z;
    }
    const auto number = static_cast<double>(p.patches.size());
    const double ideal = p.surface.area_m2 / number;
    EXPECT_LT(area / number, 1.02 * ideal) << count;
    EXPECT_LT(edge / number, 1.15 * 2.0 * std::sqrt(ideal)) << count;
  }
}

TEST(Patches, a_slave_has_a_near_master_and_its_type_and_about_its_yaw) {
  const Patches p(20000, 4);
  double distance = 0.0;
  std::size_t slaves = 0, alike = 0;
  for (const GrassBlade& blade : p.all()) {
    const GrassBlade& master = p.blades[blade.master];
    EXPECT_GE(blade.yaw, 0.0f);
    EXPECT_LT(blade.yaw, 2.0f * kPi);
    if (blade.master == blade.slot) continue;
    ++slaves;
    EXPECT_EQ(blade.type, master.type);
    EXPECT_EQ(master.master, master.slot);
    EXPECT_LE(std::abs(std::remainder(blade.yaw - master.yaw, 2.0f * kPi)), 0.6f + 1e-5f);
    EXPECT_NE(blade.length_m, master.length_m);
    // Wind bends it about as far: its width over its length is that of its master, but for the greatest widths.
    const double stout =
        double{blade.width_m} / double{blade.length_m} * double{master.length_m} / double{master.width_m};
    alike += std::abs(stout - 1.0) < 0.01 ? 1 : 0;
    distance += double{glm::length(blade.root_m - master.root_m)};
  }
  EXPECT_GT(alike, slaves / 2);
  // Twenty blades share 0.4 m²: two points of a square of that area are 0.33 m apart on average.
  EXPECT_LT(distance / static_cast<double>(slaves), 0.33);
}

TEST(Patches, types_yaws_lengths_widths_and_layers_have_their_distributions) {
  Patches p(0, 0);
  p.source.values.height_m = vec2(0.2f, 0.03f);
  p.source.values.width_m = 0.004f;
  p.source.first_type = 3;
  p.roots = scatter_roots(p.surface, 40000, 1, *make_serial_executor());
  p.append(*make_serial_executor());
  std::array<double, 5> number{};
  std::array<double, 5> sum{};
  std::array<double, 5> squares{};
  std::array<double, 8> yaws{};
  std::array<double, kGrassLayers> layers{};
  for (const GrassBlade& blade : p.all()) {
    ASSERT_GE(blade.type, 3);
    ASSERT_LT(blade.type, 8);
    const std::size_t t = blade.type - 3u;
    const BladeType& type = p.types[t];
    const double length = double{blade.length_m} / type.length_scale;
    ++number[t];
    sum[t] += length;
    squares[t] += length * length;
    EXPECT_GE(length, 0.05 - 1e-6);
    EXPECT_LE(length, 0.4 + 1e-6);
    EXPECT_NEAR(blade.width_m, 0.004f * type.width_scale, 0.2501f * 0.004f * type.width_scale);
    ++yaws[static_cast<std::size_t>(blade.yaw / (2.0f * kPi) * 8.0f)];
    ++layers[blade.layer];
  }
  double shares = 0.0;
  for (const BladeType& type : p.types) shares += double{type.share};
  for (std::size_t t = 0; t < 5; ++t) {
    EXPECT_NEAR(number[t] / 40000.0, p.types[t].share / shares, 0.01);
    const double mean = sum[t] / number[t];
    EXPECT_NEAR(mean, 0.2, 0.003);
    EXPECT_NEAR(std::sqrt(squares[t] / number[t] - mean * mean), 0.03, 0.003);
  }
  for (const double yaw : yaws) EXPECT_NEAR(yaw, 5000.0, 250.0);
  for (const double layer : layers) EXPECT_NEAR(layer, 40000.0 / kGrassLayers, 200.0);
}

TEST(Patches, lengths_stay_between_a_quarter_and_twice_the_mean) {
  Patches p(0, 4);
  p.source.values.height_m = vec2(0.2f, 10.0f);
  p.roots = scatter_roots(p.surface, 1000, 1, *make_serial_executor());
  p.append(*make_serial_executor());
  for (const GrassBlade& blade : p.all()) {
    const float mean = 0.2f * p.types[blade.type].length_scale;
    EXPECT_GE(blade.length_m, 0.2499f * mean);
    EXPECT_LE(blade.length_m, 2.0001f * mean);
  }
}

TEST(Patches, slaves_have_the_rank_of_their_master_and_ranks_of_masters_are_evenly_spaced) {
  const Patches p(1000, 4);
  for (const GrassPatch& patch : p.patches) {
    std::vector<float> ranks;
    for (const GrassBlade& blade : p.of(patch)) {
      EXPECT_EQ(blade.rank, p.blades[blade.master].rank);
      if (blade.master == blade.slot) ranks.push_back(blade.rank);
    }
    std::ranges::sort(ranks);
    EXPECT_EQ(ranks.size(), patch.masters);
    EXPECT_GE(ranks.front(), 0.0f);
    EXPECT_LT(ranks.back(), 1.0f);
    for (std::size_t i = 1; i < ranks.size(); ++i)
      EXPECT_NEAR(ranks[i] - ranks[i - 1], 1.0f / static_cast<float>(patch.masters), 1e-5f);
  }
}

TEST(Patches, a_quarter_of_the_blades_at_most_are_masters_however_many_ranks_are_left_out) {
  const Patches p(16384, 4);
  for (float most = 0.06f; most <= 1.0f; most += 0.02f) {
    double blades = 0.0, masters = 0.0;
    for (const GrassBlade& blade : p.all()) {
      if (blade.rank >= most) continue;
      blades += 1.0;
      masters += blade.master == blade.slot ? 1.0 : 0.0;
    }
    EXPECT_LE(masters, 0.25 * blades) << most;
  }
}

TEST(Patches, groups_of_low_rank_cover_the_lawn_evenly) {
  const Patches p(16384, 4);
  for (const float most : {0.1f, 0.2f, 0.5f, 0.8f}) {
    std::vector<dvec3> points;
    std::size_t blades = 0;
    for (const GrassPatch& patch : p.patches)
      for (const GrassBlade& blade : p.of(patch)) {
        if (blade.rank >= most) continue;
        ++blades;
        if (blade.master == blade.slot) points.push_back(patch.origin + dvec3(blade.root_m));
      }
    EXPECT_NEAR(static_cast<double>(blades), 16384.0 * most, 16384.0 * 0.01);
    // 1 is a random scatter; less is clumped.
    EXPECT_GE(test::clark_evans(points, p.surface.area_m2, 9.0), 0.92) << most;
  }
}

TEST(Patches, patches_of_several_surfaces_follow_each_other) {
  Patches p(300, 4);
  p.source.entity = Entity{8, 2};
  p.append(*make_serial_executor());
  ASSERT_EQ(p.patches.size(), 4u);
  for (std::uint32_t i = 0; i < 4; ++i) {
    EXPECT_EQ(p.patches[i].index, i);
    EXPECT_EQ(p.patches[i].surface.index, i < 2 ? 7u : 8u);
    for (const GrassBlade& blade : p.of(p.patches[i])) EXPECT_EQ(blade.master / kSlots, i);
  }
}

TEST(Patches, all_roots_in_one_place_are_grouped_too) {
  Patches p(0, 4);
  p.roots.assign(700, ScatteredRoot{0, 0.25, 0.25});
  p.append(*make_serial_executor());
  ASSERT_EQ(p.patches.size(), 3u);
  EXPECT_EQ(p.all().size(), 700u);
  for (const GrassPatch& patch : p.patches) EXPECT_EQ(patch.roots.min, patch.roots.max);
}

// Hard case: selftest.threads
TEST(Patches, the_result_has_the_same_bits_on_every_executor) {
  Patches expected(20000, 4);
  for (const test::ExecutorCase& c : test::all_executors()) {
    Patches p(0, 4);
    p.roots = expected.roots;
    p.append(*c.make());
    EXPECT_EQ(test::hash_of(p.patches, p.blades), test::hash_of(expected.patches, expected.blades)) << c.name;
  }
}

}  // namespace
}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "modules/particles/sorting/sort_particles_passes.h"
#include "tests/support/pass_frame.h"

namespace gloam::test {
namespace {

class ParticleSort : public ::testing::Test {
 protected:
  void SetUp() override { GLOAM_REQUIRE_GPU(device()); }
  [[nodiscard]] static gpu::Device* device() {
    static const std::unique_ptr<gpu::Device> made = make_test_device();
    return made.get();
  }
  /// Sorts these keys and compares with std::stable_sort.
  static void expect_sorted(const std::vector<std::uint32_t>& keys, bool two_digits) {
    ASSERT_EQ(keys.size() % GLOAM_PARTICLE_GROUP, 0u);
    const auto places = static_cast<std::uint32_t>(keys.size());
    ReadPassFrames frames(*device());
    frames.draw([&](FrameBuilder& frame) {
      const SortedParticles sorted = add_particle_sort_passes(frame, frames.input("keys", keys), places, two_digits);
      frames.keep(frame, "order", sorted.order, std::uint64_t{places} * sizeof(std::uint32_t));
      frames.keep(frame, "draws", sorted.draws, sizeof(shaders::ParticleDraws));
    });
    std::vector<std::uint32_t> expected(keys.size());
    std::iota(expected.begin(), expected.end(), 0u);
    std::ranges::stable_sort(expected, {}, [&](std::uint32_t i) { return keys[i]; });
    EXPECT_TRUE(frames.read<std::uint32_t>("order") == expected);
    const shaders::ParticleDraws draws = frames.read<shaders::ParticleDraws>("draws").at(0);
    const std::uint32_t culled = two_digits ? 0xFFFF : 0xFF;
    const auto drawn = static_cast<std::uint32_t>(std::ranges::count_if(keys, [&](auto key) { return key != culled; }));
    EXPECT_EQ(draws.drawn, drawn);
    EXPECT_EQ(draws.indices, 6 * GLOAM_PARTICLE_DRAW_SPRITES);
    EXPECT_EQ(draws.instances, (drawn + GLOAM_PARTICLE_DRAW_SPRITES - 1) / GLOAM_PARTICLE_DRAW_SPRITES);
    EXPECT_EQ(draws.first_index + draws.vertex_offset + draws.first_instance, 0u);
    const std::uint64_t threads = std::uint64_t{draws.light_groups.x} * draws.light_groups.y * 64;
    EXPECT_GE(threads, drawn);
    EXPECT_LE(draws.light_groups.x, 65535u);
    EXPECT_LT(threads, drawn + 32768ull * 64 + 64);
  }
  static std::vector<std::uint32_t> random_keys(std::size_t count, std::uint32_t most, std::uint32_t culled) {
    std::mt19937 random(static_cast<std::uint32_t>(count));
    std::vector<std::uint32_t> keys(count);
    for (std::uint32_t& key : keys) key = random() % 5 == 0 ? culled : static_cast<std::uint32_t>(random()) % most;
    return keys;
  }
};

TEST_F(ParticleSort, one_digit_orders_few_particles) {
  for (const std::size_t count : {64u, 128u, 256u, 1024u}) expect_sorted(random_keys(count, 0xFF, 0xFF), false);
}

TEST_F(ParticleSort, two_digits_order_many_particles_and_keep_those_of_one_key_in_order) {
  for (const std::size_t count : {64u, 320u, 4096u, 100032u}) {
    expect_sorted(random_keys(count, 0xFF00, 0xFFFF), true);
    expect_sorted(random_keys(count, 7, 0xFFFF), true);
  }
}

// Hard case: particles.none
TEST_F(ParticleSort, all_drawn_none_drawn_and_equal_keys) {
  expect_sorted(std::vector<std::uint32_t>(640, 0xFFFF), true);
  expect_sorted(std::vector<std::uint32_t>(640, 0xFF), false);
  expect_sorted(std::vector<std::uint32_t>(640, 0xFEFF), true);
  expect_sorted(std::vector<std::uint32_t>(640, 0), false);
}

}  // namespace
}  // namespace gloam::test

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "engine/render/kernel_check/engine_checks.h"
#include "engine/render/reference/sorted_twin.h"
#include "engine/render/sort/radix_sort.h"
#include "shaders/render/shaders.h"
#include "shaders/render/sort/sort_shared.h"
#include "tests/support/kernel.h"
#include "tests/support/pass_frame.h"

namespace gloam {
namespace {

constexpr std::uint32_t kSizes[] = {0,   1,   3,    4,    5,    15,   16,    17,    255,    256,      257,
                                    511, 513, 4095, 4096, 4097, 8191, 32768, 32769, 100003, 1'000'000};

using Keys = std::vector<std::uint8_t>;
using Words = std::vector<std::uint32_t>;

Keys random_keys(std::uint32_t count, std::uint32_t seed = 1) {
  std::mt19937 random(seed);
  Keys keys(count);
  for (std::uint8_t& key : keys) key = static_cast<std::uint8_t>(random());
  return keys;
}

Words random_values(std::uint32_t count) {
  std::mt19937 random(7);
  Words values(count);
  for (std::uint32_t& value : values) value = static_cast<std::uint32_t>(random());
  return values;
}

/// With the kernels for threads in turn (true) and for threads together (false), on every device.
class RadixSort : public ::testing::TestWithParam<bool> {
 protected:
  void SetUp() override {
    GLOAM_REQUIRE_GPU(device());
    messages_ = device()->validation_messages();
  }
  void TearDown() override {
    if (device()) {
      EXPECT_EQ(device()->validation_messages(), messages_);
    }
  }
  [[nodiscard]] static gpu::Device* device() {
    static const std::unique_ptr<gpu::Device> devices[] = {make(false), make(true)};
    return devices[GetParam() ? 1 : 0].get();
  }
  void expect_sorted(const Keys& keys, const Words& values = {}) {
    const auto count = static_cast<std::uint32_t>(keys.size());
    test::ReadPassFrames frames(*device());
    frames.draw([&](FrameBuilder& frame) {
      const BufferRef given_keys = count == 0 ? BufferRef{} : frames.input("keys", packed_keys(keys));
      const BufferRef given_values = values.empty() ? BufferRef{} : frames.input("values", values);
      const SortedKeys sorted = add_radix_sort_passes(frame, "tested", given_keys, given_values, count);
      if (count > 0) frames.keep(frame, "values", sorted.values, std::uint64_t{count} * 4);
      if (count > 0) frames.keep(frame, "keys", sorted.keys, packed_key_bytes(count));
      frames.keep(frame, "bins", sorted.bins, (GLOAM_SORT_BINS + 1) * 4);
    });
    const SortedTwin expected = sorted_twin(keys, values);
    EXPECT_EQ(frames.read<std::uint32_t>("bins"), expected.bins);
    if (count == 0) return;
    EXPECT_TRUE(frames.read<std::uint32_t>("values") == expected.values);
    Keys sorted_keys = frames.read<std::uint8_t>("keys");
    sorted_keys.resize(count);
    EXPECT_TRUE(sorted_keys == expected.keys);
  }

 private:
  static std::unique_ptr<gpu::Device> make(bool in_turn) {
    gpu::VulkanOptions options = test::test_device_options();
    options.threads_in_turn = in_turn;
    return test::make_test_device(true, options);
  }
  std::uint64_t messages_ = 0;
};

// Hard case: selftest.sort
TEST_P(RadixSort, sorts_random_keys_of_every_size) {
  for (const std::uint32_t count : kSizes) {
    SCOPED_TRACE(count);
    expect_sorted(random_keys(count));
  }
}

TEST_P(RadixSort, moves_given_values_with_their_keys) {
  for (const std::uint32_t count : kSizes) {
    SCOPED_TRACE(count);
    expect_sorted(random_keys(count, 2), random_values(count));
  }
}

TEST_P(RadixSort, keeps_the_order_of_equal_keys) {
  for (const std::uint32_t count : kSizes)
    for (const int key : {0, 77, 255}) {
      SCOPED_TRACE(testing::Message() << count << " keys " << key);
      expect_sorted(Keys(count, static_cast<std::uint8_t>(key)));
    }
}

TEST_P(RadixSort, sorts_only_the_lowest_and_the_highest_key) {
  for (const std::uint32_t count : kSizes) {
    SCOPED_TRACE(count);
    Keys keys = random_keys(count, 3);
    for (std::uint8_t& key : keys) key = key % 2 == 0 ? 0 : 255;
    expect_sorted(keys);
  }
}

TEST_P(RadixSort, sorts_sorted_and_reversed_keys) {
  for (const std::uint32_t count : kSizes) {
    SCOPED_TRACE(count);
    Keys keys = random_keys(count, 4);
    std::sort(keys.begin(), keys.end());
    expect_sorted(keys);
    std::reverse(keys.begin(), keys.end());
    expect_sorted(keys, random_values(count));
  }
}

TEST_P(RadixSort, sorts_eight_million_keys) { expect_sorted(random_keys(8'000'001)); }

TEST_P(RadixSort, two_sorts_of_a_frame_do_not_mix) {
  const Keys first = random_keys(5000, 5), second = random_keys(3000, 6);
  test::ReadPassFrames frames(*device());
  frames.draw([&](FrameBuilder& frame) {
    const SortedKeys a = add_radix_sort_passes(frame, "a", frames.input("first", packed_keys(first)), {}, 5000);
    const SortedKeys b = add_radix_sort_passes(frame, "b", frames.input("second", packed_keys(second)), {}, 3000);
    frames.keep(frame, "a", a.values, 5000 * 4);
    frames.keep(frame, "b", b.values, 3000 * 4);
  });
  EXPECT_TRUE(frames.read<std::uint32_t>("a") == sorted_twin(first, {}).values);
  EXPECT_TRUE(frames.read<std::uint32_t>("b") == sorted_twin(second, {}).values);
}

INSTANTIATE_TEST_SUITE_P(Kernels, RadixSort, ::testing::Values(true, false),
                         [](const auto& kernels) { return kernels.param ? "threads_in_turn" : "threads_together"; });

/// A kernel of the sort alone, with buffers larger than its results.
class SortKernel : public test::KernelTest {
 protected:
  static constexpr std::uint32_t kCount = 5003;
  static constexpr std::uint32_t kSpare = 64;  // words past the results

  static void expect_untouched(const Words& words, std::size_t from) {
    for (std::size_t i = from; i < words.size(); ++i) ASSERT_EQ(words[i], test::Kernel::kUntouched) << i;
  }
  /// The words begin with those expected, and the rest is untouched.
  static void expect_exactly(Words words, const Words& expected) {
    expect_untouched(words, expected.size());
    words.resize(expected.size());
    EXPECT_EQ(words, expected);
  }
  /// Counts of each column and bin.
  [[nodiscard]] static Words counted(const Keys& keys, const shaders::SortConstants& c) {
    Words counters(std::size_t{c.columns} * GLOAM_SORT_BINS, 0);
    for (std::size_t i = 0; i < keys.size(); ++i) ++counters[i / c.column_keys * GLOAM_SORT_BINS + keys[i]];
    return counters;
  }
  void expect_counts(const gpu::ShaderCode& shader, const shaders::SortConstants& c, std::uint32_t groups) {
    const Keys keys = random_keys(kCount);
    const Words expected = counted(keys, c);
    test::Kernel kernel(device(), shader);
    kernel.push(c);
    kernel.input(0, packed_keys(keys));
    kernel.output(1, (expected.size() + kSpare) * 4);
    kernel.run(groups);
    expect_exactly(kernel.read<std::uint32_t>(1), expected);
  }
  /// Runs scatter_runs.comp or scatter_blocks.comp.
  void expect_scatter(bool runs, const shaders::SortConstants& c, std::uint32_t groups) {
    const Keys keys = random_keys(kCount);
    const Words values = random_values(kCount);
    const SortedTwin expected = sorted_twin(keys, values);
    Words counters = counted(keys, c), totals;
    for (std::uint32_t bin = 0; bin < GLOAM_SORT_BINS; ++bin) {
      std::uint32_t before = 0;
      for (std::uint32_t column = 0; column < c.columns; ++column)
        before += std::exchange(counters[column * GLOAM_SORT_BINS + bin], before);
      totals.push_back(before);
    }
    test::Kernel kernel(device(), runs ? shaders::render::scatter_runs_comp : shaders::render::scatter_blocks_comp,
                        {{"kImpliedValues", 0u}});
    kernel.push(c);
    kernel.input(0, packed_keys(keys));
    kernel.input(1, counters);
    kernel.input(2, runs ? totals : expected.bins);
    kernel.input(3, values);
    kernel.output(4, (kCount + kSpare) * 4);
    if (runs) kernel.output(5, (GLOAM_SORT_BINS + 1 + kSpare) * 4);
    kernel.run(groups);
    expect_exactly(kernel.read<std::uint32_t>(4), expected.values);
    if (runs) expect_exactly(kernel.read<std::uint32_t>(5), expected.bins);
  }
};

// 5,003 keys: of 8 runs, 5 begin before the last key; of 2 blocks, both do.
constexpr shaders::SortConstants kRuns = {5003, 8, 1024};
constexpr shaders::SortConstants kBlocks = {5003, 2, 4096};

TEST_F(SortKernel, counting_runs_writes_nothing_past_the_columns) {
  expect_counts(shaders::render::count_runs_comp, kRuns, 1);
}
TEST_F(SortKernel, counting_blocks_writes_nothing_past_the_columns) {
  expect_counts(shaders::render::count_blocks_comp, kBlocks, 2);
}
TEST_F(SortKernel, scattering_runs_writes_nothing_past_values_and_bins) { expect_scatter(true, kRuns, 1); }
TEST_F(SortKernel, scattering_blocks_writes_nothing_past_the_values) { expect_scatter(false, kBlocks, 2); }

TEST_F(SortKernel, bins_are_the_prefix_sum_of_the_totals_and_nothing_else) {
  Words totals = random_values(GLOAM_SORT_BINS);
  for (std::uint32_t& total : totals) total %= 1000;
  Words expected(GLOAM_SORT_BINS + 1, 0);
  std::partial_sum(totals.begin(), totals.end(), expected.begin() + 1);
  test::Kernel kernel(device(), shaders::render::scan_bins_comp);
  kernel.input(0, totals);
  kernel.output(1, (GLOAM_SORT_BINS + 1 + kSpare) * 4);
  kernel.run(1);
  expect_exactly(kernel.read<std::uint32_t>(1), expected);
}

TEST_F(SortKernel, sorted_keys_end_with_the_word_of_the_last_key) {
  const Keys keys = random_keys(kCount);
  const SortedTwin expected = sorted_twin(keys, {});
  test::Kernel kernel(device(), shaders::render::write_keys_comp);
  kernel.push(kRuns);
  kernel.input(0, expected.bins);
  kernel.output(1, (kCount / 4 + 1 + kSpare) * 4);
  kernel.run((kCount / 4 + 64) / 64);
  const Words words = kernel.read<std::uint32_t>(1);
  expect_untouched(words, kCount / 4 + 1);
  Keys sorted(kCount);
  std::memcpy(sorted.data(), words.data(), kCount);
  EXPECT_EQ(sorted, expected.keys);
}

TEST_F(SortKernel, holds_in_the_self_test) { expect_holds({sort_check()}); }

}  // namespace
}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/bake.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "engine/core/storage/byte_stream.h"
#include "tests/modules/reflections/bake/bake_world.h"
#include "tests/support/temporary_folder.h"

namespace gloam {
namespace {

/// A world with three proxies, two probes and four lights. spare: entities created before each of them.
struct CaptureWorld : test::BakeWorld {
  std::vector<Entity> proxies, probes, lights;

  explicit CaptureWorld(int spare) {
    const auto skip = [&] {
      for (int i = 0; i < spare; ++i) world.create(WorldTransform{});
    };
    for (int i = 0; i < 4; ++i) {
      skip();
      lights.push_back(light("light " + std::to_string(i), Light{}, dmat4(1.0)));
      if (i < 3) proxies.push_back(world.create(IbrProxy{}, WorldTransform{}));
      skip();
      if (i < 2) probes.push_back(world.create(CubeProbe{}, WorldTransform{}));
    }
  }
  [[nodiscard]] ReflectionCaptures captures() const {
    ReflectionCaptures all;
    all.content = 0x123456789abcdef0;
    all.light_scale = 0.0625f;
    all.proxies = {4, 3, 2, {}};
    all.proxies.texels.resize(2 * all.proxies.layer_halves());
    for (std::size_t i = 0; i < all.proxies.texels.size(); ++i) all.proxies.texels[i] = static_cast<std::uint16_t>(i);
    all.proxy_entities = {proxies[0], proxies[2]};
    all.proxy_lights = {{0, lights[1], 1.0f}, {1, lights[0], 0.25f}, {1, lights[3], 0.75f}};
    all.probes = {8, 1, 1, std::vector<std::uint16_t>(8 * 8 * 4, 7)};
    all.probe_entities = {probes[1]};
    all.probe_diffuse.emplace_back();
    all.probe_diffuse[0].lamps[3] = vec3(1.0f, 2.0f, 3.0f);
    all.probe_diffuse[0].unlit[8] = vec3(-4.0f, 5.0f, 6.0f);
    all.grid = {{dvec3(1e9, 0.25, -3.0), vec3(0.5f, 1.0f, 2.0f), vec3(7.0f), all.probe_diffuse[0]}, {}};
    for (const Entity light : lights) all.lights.push_back({light, vec3(1.5f, 2.0f, static_cast<float>(light.index))});
    return all;
  }
};

void expect_equal(const ReflectionCaptures& a, const ReflectionCaptures& b) {
  EXPECT_EQ(a.content, b.content);
  EXPECT_EQ(a.light_scale, b.light_scale);
  for (const auto layers : {&ReflectionCaptures::proxies, &ReflectionCaptures::probes}) {
    EXPECT_EQ((a.*layers).side, (b.*layers).side);
    EXPECT_EQ((a.*layers).mips, (b.*layers).mips);
    EXPECT_EQ((a.*layers).count, (b.*layers).count);
    EXPECT_EQ((a.*layers).texels, (b.*layers).texels);
  }
  EXPECT_EQ(a.proxy_entities, b.proxy_entities);
  EXPECT_EQ(a.probe_entities, b.probe_entities);
  ASSERT_EQ(a.probe_diffuse.size(), b.probe_diffuse.size());
  for (std::size_t i = 0; i < a.probe_diffuse.size(); ++i) {
    EXPECT_EQ(a.probe_diffuse[i].lamps, b.probe_diffuse[i].lamps);
    EXPECT_EQ(a.probe_diffuse[i].unlit, b.probe_diffuse[i].unlit);
  }
  ASSERT_EQ(a.grid.size(), b.grid.size());
  for (std::size_t i = 0; i < a.grid.size(); ++i) {
    EXPECT_EQ(a.grid[i].center, b.grid[i].center);
    EXPECT_EQ(a.grid[i].half, b.grid[i].half);
    EXPECT_EQ(a.grid[i].lamps_lux, b.grid[i].lamps_lux);
    EXPECT_EQ(a.grid[i].diffuse.lamps, b.grid[i].diffuse.lamps);
    EXPECT_EQ(a.grid[i].diffuse.unlit, b.grid[i].diffuse.unlit);
  }
  ASSERT_EQ(a.proxy_lights.size(), b.proxy_lights.size());
  for (std::size_t i = 0; i < a.proxy_lights.size(); ++i) {
    EXPECT_EQ(a.proxy_lights[i].layer, b.proxy_lights[i].layer);
    EXPECT_EQ(a.proxy_lights[i].light, b.proxy_lights[i].light);
    EXPECT_EQ(a.proxy_lights[i].weight, b.proxy_lights[i].weight);
  }
  ASSERT_EQ(a.lights.size(), b.lights.size());
  for (std::size_t i = 0; i < a.lights.size(); ++i) {
    EXPECT_EQ(a.lights[i].light, b.lights[i].light);
    EXPECT_EQ(a.lights[i].emitted, b.lights[i].emitted);
  }
}

struct CacheFile : testing::Test {
  test::TestFolder folder;
  std::string path = folder.path() + "/captures/courtyard.captures";
  CaptureWorld scene{0};
  ReflectionCaptures captures = scene.captures();
  int lines = 0;
  FunctionLog log{[this](LogLevel, std::string_view) { ++lines; }};

  [[nodiscard]] std::optional<ReflectionCaptures> load() {
    return load_captures(path, scene.world, captures.content, log);
  }
};

TEST_F(CacheFile, gives_back_what_was_saved) {
  EXPECT_FALSE(load());
  ASSERT_TRUE(save_captures(path, scene.world, captures).ok());
  const auto loaded = load();
  ASSERT_TRUE(loaded);
  expect_equal(*loaded, captures);
  EXPECT_EQ(lines, 0);
}

TEST_F(CacheFile, is_read_into_a_world_with_other_entity_indices) {
  ASSERT_TRUE(save_captures(path, scene.world, captures).ok());
  const CaptureWorld other(5);
  auto loaded = load_captures(path, other.world, captures.content, log);
  ASSERT_TRUE(loaded);
  ReflectionCaptures expected = other.captures();
  for (std::size_t i = 0; i < expected.lights.size(); ++i) expected.lights[i].emitted = captures.lights[i].emitted;
  expect_equal(*loaded, expected);
}

/// Captures without anything but proxy layers of this form, and no texels.
std::string bytes_with_layers(std::uint32_t side, std::uint32_t mips, std::uint32_t count) {
  constexpr int kOtherCounts = 11;
  ByteWriter bytes;
  bytes.value(std::uint64_t{1});
  bytes.value(1.0f);
  for (const std::uint32_t number : {side, mips, count}) bytes.value(number);
  for (int i = 0; i < kOtherCounts; ++i) bytes.value(std::uint32_t{0});
  return bytes.take();
}

TEST_F(CacheFile, layers_of_more_texels_than_numbers_reach_are_refused) {
  ASSERT_TRUE(decode_captures(scene.world, bytes_with_layers(0, 0, 0)));
  EXPECT_FALSE(decode_captures(scene.world, bytes_with_layers(1u << 16, 1, 1u << 30))) << "2^64 half floats";
  EXPECT_FALSE(decode_captures(scene.world, bytes_with_layers(3, 1, 0))) << "no power of two";
  EXPECT_FALSE(decode_captures(scene.world, bytes_with_layers(4, 4, 0))) << "4 texels have 3 mips";
}

TEST_F(CacheFile, that_is_damaged_cut_short_or_of_other_content_is_told_and_replaced) {
  ASSERT_TRUE(save_captures(path, scene.world, captures).ok());
  EXPECT_FALSE(load_captures(path, scene.world, captures.content + 1, log));
  EXPECT_EQ(lines, 1);
  const auto size = static_cast<std::size_t>(std::filesystem::file_size(path));
  for (const std::size_t at : {std::size_t{3}, size / 3, size - 2}) {
    std::fstream(path, std::ios::binary | std::ios::in | std::ios::out).seekp(static_cast<std::streamoff>(at)).put('~');
    EXPECT_FALSE(load()) << at;
    ASSERT_TRUE(save_captures(path, scene.world, captures).ok());
    ASSERT_TRUE(load()) << at;
    std::filesystem::resize_file(path, at);
    EXPECT_FALSE(load()) << at;
    ASSERT_TRUE(save_captures(path, scene.world, captures).ok());
  }
  EXPECT_EQ(lines, 7);
  EXPECT_TRUE(load());
}

TEST_F(CacheFile, bytes_that_are_too_few_too_many_or_name_absent_entities_are_refused) {
  const std::string bytes = encode_captures(scene.world, captures);
  EXPECT_TRUE(decode_captures(scene.world, bytes));
  for (std::size_t i = 0; i < bytes.size(); ++i) EXPECT_FALSE(decode_captures(scene.world, bytes.substr(0, i)));
  EXPECT_FALSE(decode_captures(scene.world, bytes + "x"));
  EXPECT_FALSE(decode_captures(test::BakeWorld().world, bytes));
  // Every number of 32 bits as large as can be: sizes and counts must not be believed.
  for (std::size_t i = 0; i + 4 <= bytes.size(); i += 4) {
    std::string huge = bytes;
    huge.replace(i, 4, "\xff\xff\xff\xff");
    static_cast<void>(decode_captures(scene.world, huge));
  }
}

TEST_F(CacheFile, attached_captures_have_another_version) {
  attach_captures(scene.world, captures);
  const std::uint64_t first = scene.world.resource<ReflectionCaptures>().version;
  attach_captures(scene.world, captures);
  EXPECT_NE(first, 0u);
  EXPECT_NE(scene.world.resource<ReflectionCaptures>().version, first);
}

}  // namespace
}  // namespace gloam

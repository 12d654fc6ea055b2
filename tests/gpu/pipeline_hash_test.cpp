// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/gpu/pipeline_hash.h"

#include <gtest/gtest.h>

#include <functional>
#include <set>
#include <vector>

namespace gloam::gpu {
namespace {

constexpr std::uint32_t kWords[] = {1, 2, 3};
constexpr std::uint32_t kSameWords[] = {1, 2, 3};
constexpr std::uint32_t kOtherWords[] = {1, 2, 4};

GraphicsPipelineDesc drawn() {
  GraphicsPipelineDesc desc;
  desc.vertex.words = kWords;
  desc.fragment.words = kWords;
  desc.constants = {{"kFirst", 4u}, {"kSecond", 7u}};
  desc.attributes = {{0, 0, Format::rgba32_float, 0}};
  desc.stream_strides = {16};
  desc.color_formats = {Format::rgba16_float};
  return desc;
}

TEST(PipelineHash, every_field_of_a_graphics_pipeline_counts) {
  const std::vector<std::function<void(GraphicsPipelineDesc&)>> changes = {
      [](auto&) {},
      [](auto& d) { d.vertex.words = kOtherWords; },
      [](auto& d) { d.fragment.words = kOtherWords; },
      [](auto& d) { d.fragment.words = {}; },
      [](auto& d) { d.constants.set("kSecond", 8u); },
      [](auto& d) { d.constants.set("kThird", 7u); },
      [](auto& d) {
        d.constants = {{"kFirst", 4u}, {"kThird", 7u}};
      },
      [](auto& d) {
        d.constants = {{"kFirst", 7u}, {"kSecond", 4u}};
      },
      [](auto& d) {
        d.constants = {{"kFirst", 4u}};
      },
      [](auto& d) { d.attributes[0].location = 1; },
      [](auto& d) { d.attributes[0].stream = 1; },
      [](auto& d) { d.attributes[0].format = Format::rg32_float; },
      [](auto& d) { d.attributes[0].offset = 4; },
      [](auto& d) { d.attributes.clear(); },
      [](auto& d) { d.stream_strides[0] = 20; },
      [](auto& d) { d.color_formats[0] = Format::rgba8_srgb; },
      [](auto& d) { d.color_formats.clear(); },
      [](auto& d) { d.depth_format = Format::d32_float; },
      [](auto& d) { d.cull = CullMode::front; },
      [](auto& d) { d.blend = BlendMode::additive; },
      [](auto& d) { d.depth_compare = CompareOp::equal; },
      [](auto& d) { d.depth_write = false; },
      [](auto& d) { d.depth_bias = true; }};
  for (const ShaderIdentity identity : {ShaderIdentity::address, ShaderIdentity::words}) {
    std::set<std::uint64_t> hashes;
    for (const auto& change : changes) {
      GraphicsPipelineDesc desc = drawn();
      change(desc);
      EXPECT_TRUE(hashes.insert(description_hash(desc, identity)).second) << "change " << hashes.size();
    }
  }
}

TEST(PipelineHash, the_order_of_constants_does_not_count) {
  GraphicsPipelineDesc other = drawn();
  other.constants = {{"kSecond", 7u}, {"kFirst", 4u}};
  GraphicsPipelineDesc replaced = drawn();
  replaced.constants.set("kFirst", 9u);
  replaced.constants.set_if_present("kFirst", 4u);
  for (const ShaderIdentity identity : {ShaderIdentity::address, ShaderIdentity::words}) {
    EXPECT_EQ(description_hash(other, identity), description_hash(drawn(), identity));
    EXPECT_EQ(description_hash(replaced, identity), description_hash(drawn(), identity));
  }
}

TEST(PipelineHash, names_and_modules_do_not_count) {
  GraphicsPipelineDesc named = drawn();
  named.name = "name";
  named.module = "lights";
  named.vertex.name = "vertex";
  named.fragment.name = "fragment";
  for (const ShaderIdentity identity : {ShaderIdentity::address, ShaderIdentity::words})
    EXPECT_EQ(description_hash(named, identity), description_hash(drawn(), identity));
}

TEST(PipelineHash, equal_words_at_two_addresses_are_one_shader_by_words_only) {
  ComputePipelineDesc one, two;
  one.shader.words = kWords;
  two.shader.words = kSameWords;
  EXPECT_EQ(description_hash(one, ShaderIdentity::words), description_hash(two, ShaderIdentity::words));
  EXPECT_NE(description_hash(one, ShaderIdentity::address), description_hash(two, ShaderIdentity::address));
  two.constants = {{"kFirst", 1u}};
  EXPECT_NE(description_hash(one, ShaderIdentity::words), description_hash(two, ShaderIdentity::words));
}

}  // namespace
}  // namespace gloam::gpu

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/pipelines/pipeline_record.h"

#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <span>
#include <string>
#include <thread>
#include <utility>
#include <variant>

#include "engine/core/hash.h"
#include "engine/gpu/pipeline_hash.h"
#include "engine/gpu/recording/device.h"
#include "engine/render/pipelines/pipelines.h"

namespace gloam {
namespace {

constexpr std::array<std::uint32_t, 3> kOneWords = {1, 2, 3}, kTwoWords = {4, 5, 6};
constexpr gpu::ShaderCode kOne{"test/one.comp", kOneWords}, kTwo{"test/two.vert", kTwoWords};
constexpr std::array<const gpu::ShaderCode*, 2> kBoth = {&kOne, &kTwo};

gpu::ComputePipelineDesc compute() {
  gpu::ComputePipelineDesc desc;
  desc.module = "lights";
  desc.shader = kOne;
  desc.constants = {{"kScale", 0.5f}, {"kOn", true}, {"kSide", -3}};
  desc.constants.set_if_present("kSteps", 7u);
  return desc;
}

gpu::GraphicsPipelineDesc graphics() {
  gpu::GraphicsPipelineDesc desc;
  desc.name = "posts";
  desc.module = "shadows";
  desc.vertex = kTwo;
  desc.fragment = kOne;
  desc.attributes = {{0, 0, gpu::Format::rgb32_float, 0}, {2, 1, gpu::Format::rg16_float, 8}};
  desc.stream_strides = {12, 16};
  desc.color_formats = {gpu::Format::rgba16_float};
  desc.depth_format = gpu::Format::d32_float;
  desc.cull = gpu::CullMode::none;
  desc.blend = gpu::BlendMode::premultiplied;
  desc.depth_write = false;
  desc.depth_bias = true;
  return desc;
}

TEST(PipelineRecord, gives_the_same_pipelines_back) {
  gpu::GraphicsPipelineDesc depth_only = graphics();
  depth_only.fragment = {};
  depth_only.color_formats.clear();
  const std::string record = pipeline_record({compute(), graphics(), depth_only});
  EXPECT_EQ(record, pipeline_record({graphics(), depth_only, compute()}));
  PipelineNames names;
  const PipelineList list = parse_pipeline_record(record, kBoth, names);
  ASSERT_EQ(list.size(), 3u);
  EXPECT_EQ(pipeline_record(list), record);
  int found = 0;
  for (const auto& any : list) {
    if (const auto* desc = std::get_if<gpu::ComputePipelineDesc>(&any)) {
      found += Pipelines::key_of(*desc) == Pipelines::key_of(compute()) && desc->constants == compute().constants;
    } else {
      const auto& drawn = std::get<gpu::GraphicsPipelineDesc>(any);
      const auto& wanted = drawn.fragment.words.empty() ? depth_only : graphics();
      found += Pipelines::key_of(drawn) == Pipelines::key_of(wanted) && drawn.name == "posts";
    }
  }
  EXPECT_EQ(found, 3);
}

TEST(PipelineRecord, pipelines_of_unknown_shaders_are_left_out) {
  const std::string record = pipeline_record({compute(), graphics()});
  PipelineNames names;
  const std::array<const gpu::ShaderCode*, 1> one = {&kOne};
  EXPECT_EQ(parse_pipeline_record(record, one, names).size(), 1u);
  const gpu::ShaderCode changed{"test/one.comp", kTwoWords};  // of another build
  const std::array<const gpu::ShaderCode*, 2> other = {&changed, &kTwo};
  EXPECT_TRUE(parse_pipeline_record(record, other, names).empty());
}

TEST(PipelineRecord, a_damaged_record_is_empty) {
  const std::string record = pipeline_record({compute(), graphics()});
  PipelineNames names;
  for (std::size_t length = 0; length < record.size(); ++length)
    EXPECT_TRUE(parse_pipeline_record(std::string_view(record).substr(0, length), kBoth, names).empty()) << length;
  for (std::size_t at = 0; at < record.size(); ++at) {
    std::string damaged = record;
    damaged[at] = static_cast<char>(damaged[at] ^ 4);
    EXPECT_TRUE(parse_pipeline_record(damaged, kBoth, names).empty()) << at;
  }
}

TEST(PipelineRecord, numbers_that_are_no_value_of_their_type_are_refused) {
  const std::string record = pipeline_record({compute(), graphics()});
  for (const auto& [sound, wrong] : {std::pair<std::string, std::string>{R"("blend":2)", R"("blend":5)"},
                                     {R"("cull":0)", R"("cull":-1)"},
                                     {R"("depth_compare":5)", R"("depth_compare":7)"},
                                     {R"("depth_format":24)", R"("depth_format":25)"},
                                     {R"("type":3)", R"("type":260)"},
                                     {R"("bits":7)", R"("bits":1e30)"}}) {
    std::string body = record.substr(record.find('\n') + 1);
    ASSERT_NE(body.find(sound), std::string::npos) << sound << " in " << body;
    body.replace(body.find(sound), sound.size(), wrong);
    const std::uint64_t checksum = hash_bytes(std::as_bytes(std::span(body)));
    PipelineNames names;
    const std::string written = R"({"pipelines":1,"checksum":)" + std::to_string(checksum) + "}\n" + body;
    EXPECT_TRUE(parse_pipeline_record(written, kBoth, names).empty()) << wrong;
  }
}

TEST(PipelineRecord, recorded_pipelines_are_made_once_in_the_background_or_by_the_frame) {
  const std::unique_ptr<gpu::RecordingDevice> device = gpu::make_recording_device();
  std::string record;
  {
    Pipelines pipelines(*device);
    ASSERT_TRUE(pipelines.get(compute()).ok());
    ASSERT_TRUE(pipelines.get(graphics()).ok());
    record = pipelines.record();
  }
  EXPECT_EQ(device->pipeline_count("lights"), 0u);
  for (int run = 0; run < 50; ++run) {
    Pipelines pipelines(*device);
    EXPECT_EQ(pipelines.request_record(record, kBoth, null_log()), 2u);
    // The frame asks for one of them at once: the background may have it made, be making it, or not.
    const auto made = pipelines.get(compute());
    ASSERT_TRUE(made.ok());
    for (int wait = 0; wait < 2000 && pipelines.pending() > 0; ++wait)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    EXPECT_EQ(pipelines.pending(), 0u);
    EXPECT_EQ(pipelines.find(compute()), *made);
    EXPECT_TRUE(pipelines.find(graphics()));
    EXPECT_EQ(device->pipeline_count("lights"), 1u);
    EXPECT_EQ(device->pipeline_count("shadows"), 1u);
    EXPECT_EQ(pipelines.record(), record) << "find() has asked for the other one";
  }
  EXPECT_TRUE(device->faults().empty()) << device->faults().front();
}

}  // namespace
}  // namespace gloam

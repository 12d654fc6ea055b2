// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/gpu/vulkan/submission/command_list.h"

#include <array>

#include "engine/gpu/vulkan/device.h"
#include "engine/gpu/vulkan_interop.h"
#include "shaders/gpu_test/shaders.h"
#include "tests/gpu/vulkan/device_fixture.h"

namespace gloam::gpu {
namespace {

using Texel = std::array<std::uint8_t, 4>;
using enum ImageUsage;

struct Vertex {
  std::array<float, 3> position;
  std::array<std::uint8_t, 4> color;
};

constexpr std::uint32_t kSize = 32;
constexpr Texel kClear = {0, 0, 51, 255};

/// Draws triangles with the test shaders into a colour and a depth image; set 1 holds the tints.
class CommandLists : public VulkanTest {
 protected:
  void SetUp() override {
    VulkanTest::SetUp();
    if (!device_) return;
    color_ = make_target(Format::rgba8_unorm, color_target | transfer_source);
    depth_ = make_target(Format::d32_float, depth_target | transfer_source);
    brightness_ = test::make_upload(device(), std::vector<float>{1.0f});
    tints_ = test::make_upload(device(), std::vector<std::array<float, 4>>{{1, 1, 1, 1}, {0, 1, 0, 1}});
  }

  ImageHandle make_target(Format format, ImageUsage usage) {
    return test::value_of(device().create_image(
        {.name = "target", .module = "test", .format = format, .width = kSize, .height = kSize, .usage = usage}));
  }

  GraphicsPipelineDesc desc() {
    return {.name = "triangle",
            .module = "test",
            .vertex = shaders::gpu_test::triangle_vert,
            .fragment = shaders::gpu_test::triangle_frag,
            .attributes = {{.location = 0, .stream = 0, .format = Format::rgb32_float, .offset = 0},
                           {.location = 1, .stream = 0, .format = Format::rgba8_unorm, .offset = 12}},
            .stream_strides = {sizeof(Vertex)},
            .color_formats = {Format::rgba8_unorm},
            .depth_format = Format::d32_float};
  }

  /// A triangle over the lower left half of the image, counter-clockwise on screen.
  static std::vector<Vertex> lower_left(float depth, Texel color) {
    return {{{-1, -1, depth}, color}, {{1, -1, depth}, color}, {{-1, 1, depth}, color}};
  }

  void begin(CommandList& commands, LoadOp load = LoadOp::clear) {
    to(commands, color_, Access::none, Access::color_target);
    to(commands, depth_, Access::none, Access::depth_target);
    const std::array<float, 4> clear = {0.0f, 0.0f, 0.2f, 1.0f};
    commands.begin_rendering({.colors = {{.view = {.image = color_}, .load = load, .clear = clear}},
                              .depth = {.view = {.image = depth_}},
                              .width = kSize,
                              .height = kSize});
  }

  void bind(CommandList& commands, PipelineHandle pipeline, ResourceSetHandle set, std::uint32_t tint) {
    commands.bind_pipeline(pipeline);
    commands.bind(std::array{Binding{0, Binding::BufferRange{brightness_}}});
    commands.bind_set(1, set);
    commands.push(tint);
  }

  ResourceSetHandle make_set(PipelineHandle pipeline) {
    return test::value_of(
        device().create_resource_set(pipeline, 1, std::array{Binding{3, Binding::BufferRange{tints_}}}));
  }

  /// Draws `vertices` with a pipeline of this description and returns the colours.
  std::vector<Texel> draw(const GraphicsPipelineDesc& pipeline_desc, const std::vector<Vertex>& vertices,
                          std::uint32_t tint = 0) {
    const auto pipeline = test::value_of(device().create_pipeline(pipeline_desc));
    const ResourceSetHandle set = make_set(pipeline);
    const BufferHandle buffer = test::make_upload(device(), vertices);
    BufferHandle read;
    test::run_frame(device(), [&](CommandList& commands) {
      begin(commands);
      bind(commands, pipeline, set, tint);
      commands.bind_vertex_stream(0, buffer, 0);
      commands.draw(static_cast<std::uint32_t>(vertices.size()), 1, 0, 0);
      commands.end_rendering();
      read = read_layer(commands, color_, Access::color_target);
      read_depth_ = read_layer(commands, depth_, Access::depth_target);
    });
    device().destroy(set);
    return test::items_of<Texel>(device(), read);
  }

  static Texel at(const std::vector<Texel>& texels, std::uint32_t x, std::uint32_t y) { return texels[y * kSize + x]; }

  ImageHandle color_;
  ImageHandle depth_;
  BufferHandle brightness_;
  BufferHandle tints_;
  BufferHandle read_depth_;
};

TEST_F(CommandLists, a_triangle_fills_its_half_of_the_picture_with_y_up) {
  const auto texels = draw(desc(), lower_left(0.5f, {255, 0, 0, 255}));
  EXPECT_EQ(at(texels, 2, kSize - 3), (Texel{255, 0, 0, 255}));
  EXPECT_EQ(at(texels, kSize - 3, 2), kClear);
  const auto depths = test::items_of<float>(device(), read_depth_);
  EXPECT_FLOAT_EQ(depths[(kSize - 3) * kSize + 2], 0.5f);
  EXPECT_FLOAT_EQ(depths[2 * kSize + kSize - 3], 0.0f);
}

TEST_F(CommandLists, a_prepared_set_and_push_constants_reach_the_fragments) {
  const auto texels = draw(desc(), lower_left(0.5f, {255, 255, 255, 255}), 1);
  EXPECT_EQ(at(texels, 2, kSize - 3), (Texel{0, 255, 0, 255}));
}

TEST_F(CommandLists, culling_goes_by_the_winding_seen_in_the_picture) {
  std::vector<Vertex> clockwise = lower_left(0.5f, {255, 0, 0, 255});
  std::swap(clockwise[1], clockwise[2]);
  EXPECT_EQ(at(draw(desc(), clockwise), 2, kSize - 3), kClear);
  GraphicsPipelineDesc front = desc();
  front.cull = CullMode::front;
  EXPECT_EQ(at(draw(front, clockwise), 2, kSize - 3), (Texel{255, 0, 0, 255}));
  GraphicsPipelineDesc both = desc();
  both.cull = CullMode::none;
  EXPECT_EQ(at(draw(both, clockwise), 2, kSize - 3), (Texel{255, 0, 0, 255}));
}

TEST_F(CommandLists, the_larger_depth_wins_with_reversed_z) {
  auto vertices = lower_left(0.75f, {255, 0, 0, 255});
  for (const Vertex& v : lower_left(0.25f, {0, 255, 0, 255})) vertices.push_back(v);
  EXPECT_EQ(at(draw(desc(), vertices), 2, kSize - 3), (Texel{255, 0, 0, 255}));
  GraphicsPipelineDesc always = desc();
  always.depth_compare = CompareOp::always;
  EXPECT_EQ(at(draw(always, vertices), 2, kSize - 3), (Texel{0, 255, 0, 255}));
}

TEST_F(CommandLists, blending_adds_to_what_is_there) {
  GraphicsPipelineDesc additive = desc();
  additive.blend = BlendMode::additive;
  EXPECT_EQ(at(draw(additive, lower_left(0.5f, {255, 0, 0, 255})), 2, kSize - 3), (Texel{255, 0, 51, 255}));
  GraphicsPipelineDesc alpha = desc();
  alpha.blend = BlendMode::alpha;
  const Texel mixed = at(draw(alpha, lower_left(0.5f, {255, 0, 0, 0})), 2, kSize - 3);
  EXPECT_EQ(mixed, kClear);
}

TEST_F(CommandLists, a_pipeline_without_fragments_writes_depth_alone) {
  GraphicsPipelineDesc only_depth = desc();
  only_depth.fragment = {};
  only_depth.color_formats = {};
  only_depth.depth_bias = true;
  const auto pipeline = test::value_of(device().create_pipeline(only_depth));
  const BufferHandle buffer = test::make_upload(device(), lower_left(0.5f, {}));
  BufferHandle read;
  test::run_frame(device(), [&](CommandList& commands) {
    to(commands, depth_, Access::none, Access::depth_target);
    commands.begin_rendering({.depth = {.view = {.image = depth_}}, .width = kSize, .height = kSize});
    commands.set_depth_bias(0.0f, 0.0f);
    commands.bind_pipeline(pipeline);
    commands.bind_vertex_stream(0, buffer, 0);
    commands.draw(3, 1, 0, 0);
    commands.end_rendering();
    read = read_layer(commands, depth_, Access::depth_target);
  });
  EXPECT_FLOAT_EQ(test::items_of<float>(device(), read)[(kSize - 3) * kSize + 2], 0.5f);
}

TEST_F(CommandLists, indexed_and_indirect_draws_take_their_vertices_and_the_scissor_cuts) {
  const auto pipeline = test::value_of(device().create_pipeline(desc()));
  const ResourceSetHandle set = make_set(pipeline);
  const BufferHandle vertices = test::make_upload(device(), lower_left(0.5f, {255, 0, 0, 255}));
  const BufferHandle indices = test::make_upload(device(), std::vector<std::uint32_t>{77, 0, 1, 2});
  const BufferHandle arguments = test::make_upload(device(), std::vector<std::uint32_t>{3, 1, 1, 0, 0});
  BufferHandle read;
  test::run_frame(device(), [&](CommandList& commands) {
    begin(commands);
    bind(commands, pipeline, set, 0);
    commands.bind_vertex_stream(0, vertices, 0);
    commands.bind_indices(indices, 0);
    commands.set_scissor(0, 0, kSize / 2, kSize);
    commands.set_viewport(0, 0, kSize, kSize);
    commands.draw_indexed(3, 1, 1, 0, 0);
    commands.set_scissor(0, 0, kSize, kSize);
    commands.push(1u);
    commands.set_viewport(kSize / 2, kSize / 2, kSize / 2, kSize / 2);
    commands.draw_indexed_indirect(arguments, 0, 1);
    commands.end_rendering();
    read = read_layer(commands, color_, Access::color_target);
  });
  const auto texels = test::items_of<Texel>(device(), read);
  EXPECT_EQ(at(texels, 2, kSize - 3), (Texel{255, 0, 0, 255}));
  EXPECT_EQ(at(texels, kSize / 2 + 1, kSize - 3), (Texel{0, 0, 0, 255}));  // green tint on red, in the small viewport
  EXPECT_EQ(at(texels, kSize - 2, 2), kClear);
}

TEST_F(CommandLists, native_commands_leave_viewport_and_scissor_as_they_were) {
  const auto pipeline = test::value_of(device().create_pipeline(desc()));
  const ResourceSetHandle set = make_set(pipeline);
  const BufferHandle vertices = test::make_upload(device(), lower_left(0.5f, {255, 0, 0, 255}));
  const vulkan::DeviceFunctions& vk = dynamic_cast<vulkan::VulkanDevice&>(device()).context().vk;
  BufferHandle read;
  test::run_frame(device(), [&](CommandList& commands) {
    begin(commands);
    commands.set_viewport(0, 0, kSize / 2, kSize);
    commands.set_scissor(0, kSize / 2, kSize, kSize / 2);
    {
      const NativeCommands native = native_commands(commands);
      const VkViewport viewport = {3, 3, 2, 2, 0.0f, 0.5f};
      const VkRect2D scissor = {{1, 1}, {1, 1}};
      vk.vkCmdSetViewport(native.get(), 0, 1, &viewport);
      vk.vkCmdSetScissor(native.get(), 0, 1, &scissor);
    }
    bind(commands, pipeline, set, 0);
    commands.bind_vertex_stream(0, vertices, 0);
    commands.draw(3, 1, 0, 0);
    commands.end_rendering();
    read = read_layer(commands, color_, Access::color_target);
  });
  const auto texels = test::items_of<Texel>(device(), read);
  EXPECT_EQ(at(texels, 2, kSize - 3), (Texel{255, 0, 0, 255}));
  EXPECT_EQ(at(texels, kSize / 2 + 1, kSize - 3), kClear) << "the viewport ends before it";
  EXPECT_EQ(at(texels, 0, kSize / 2 - 1), kClear) << "the scissor begins below it";
}

TEST_F(CommandLists, a_draw_without_indices_takes_its_counts_from_a_buffer) {
  const auto pipeline = test::value_of(device().create_pipeline(desc()));
  const ResourceSetHandle set = make_set(pipeline);
  const BufferHandle vertices = test::make_upload(device(), lower_left(0.5f, {255, 0, 0, 255}));
  const BufferHandle arguments = test::make_upload(device(), std::vector<std::uint32_t>{7, 3, 0, 0, 0, 3, 1, 0, 0});
  const auto drawn = [&](std::uint64_t offset) {
    BufferHandle read;
    test::run_frame(device(), [&](CommandList& commands) {
      begin(commands);
      bind(commands, pipeline, set, 0);
      commands.bind_vertex_stream(0, vertices, 0);
      commands.set_scissor(0, 0, kSize, kSize);
      commands.set_viewport(0, 0, kSize, kSize);
      commands.draw_indirect(arguments, offset);
      commands.end_rendering();
      read = read_layer(commands, color_, Access::color_target);
    });
    return at(test::items_of<Texel>(device(), read), 2, kSize - 3);
  };
  EXPECT_EQ(drawn(5 * sizeof(std::uint32_t)), (Texel{255, 0, 0, 255}));
  EXPECT_EQ(drawn(2 * sizeof(std::uint32_t)), kClear) << "no vertices";
}

TEST_F(CommandLists, depth_may_be_tested_and_kept_read_only) {
  GraphicsPipelineDesc testing = desc();
  testing.depth_write = false;
  const auto writer = test::value_of(device().create_pipeline(desc()));
  const auto tester = test::value_of(device().create_pipeline(testing));
  const ResourceSetHandle set = make_set(writer);
  const BufferHandle near_one = test::make_upload(device(), lower_left(0.75f, {255, 0, 0, 255}));
  const BufferHandle far_one = test::make_upload(device(), lower_left(0.25f, {0, 255, 0, 255}));
  BufferHandle read;
  test::run_frame(device(), [&](CommandList& commands) {
    begin(commands);
    bind(commands, writer, set, 0);
    commands.bind_vertex_stream(0, near_one, 0);
    commands.draw(3, 1, 0, 0);
    commands.end_rendering();
    to(commands, color_, Access::color_target, Access::color_target);
    to(commands, depth_, Access::depth_target, Access::depth_test);
    commands.begin_rendering({.colors = {{.view = {.image = color_}, .load = LoadOp::load}},
                              .depth = {.view = {.image = depth_}, .load = LoadOp::load, .read_only = true},
                              .width = kSize,
                              .height = kSize});
    bind(commands, tester, set, 0);
    commands.bind_vertex_stream(0, far_one, 0);
    commands.draw(3, 1, 0, 0);
    commands.end_rendering();
    read = read_layer(commands, color_, Access::color_target);
  });
  EXPECT_EQ(at(test::items_of<Texel>(device(), read), 2, kSize - 3), (Texel{255, 0, 0, 255}));
}

}  // namespace
}  // namespace gloam::gpu

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// Command lists of a real device as careless passes record them: each kind of misuse, and the sentence that names it.
#include <array>

#include "engine/gpu/vulkan_interop.h"
#include "shaders/gpu_test/shaders.h"
#include "tests/support/expect_assert.h"
#include "tests/support/gpu_device.h"

namespace gloam::gpu {
namespace {

using enum BufferUsage;

constexpr std::uint32_t kSide = 16;

/// A frame of a real device, a compute pipeline and a graphics pipeline. The frame is abandoned.
class CommandMisuse : public ::testing::Test {
 protected:
  void SetUp() override {
    device_ = test::make_test_device(false);
    GLOAM_REQUIRE_GPU(device_);
    step_ = test::value_of(device_->create_pipeline(
        ComputePipelineDesc{.name = "step", .module = "test", .shader = shaders::gpu_test::step_comp}));
    triangle_ = test::value_of(device_->create_pipeline(
        GraphicsPipelineDesc{.name = "triangle",
                             .module = "test",
                             .vertex = shaders::gpu_test::triangle_vert,
                             .fragment = shaders::gpu_test::triangle_frag,
                             .attributes = {{.location = 0, .stream = 0, .format = Format::rgb32_float, .offset = 0},
                                            {.location = 1, .stream = 0, .format = Format::rgba8_unorm, .offset = 12}},
                             .stream_strides = {16},
                             .color_formats = {Format::rgba8_unorm}}));
    target_ = test::value_of(device_->create_image({.name = "target",
                                                    .module = "test",
                                                    .format = Format::rgba8_unorm,
                                                    .width = kSide,
                                                    .height = kSide,
                                                    .usage = ImageUsage::color_target}));
    buffer_ = test::make_storage(*device_, 1024);
    commands_ = test::value_of(device_->begin_frame());
  }
  void TearDown() override {
    if (device_ == nullptr) return;
    EXPECT_TRUE(device_->abandon_frame().ok());
    EXPECT_TRUE(device_->wait_idle().ok());
  }
  void begin_rendering() {
    const ImageBarrier ready{.image = target_, .after = Access::color_target};
    commands_->barrier({}, {&ready, 1});
    commands_->begin_rendering({.colors = {{.view = {.image = target_}}}, .width = kSide, .height = kSide});
  }

  std::unique_ptr<Device> device_;
  PipelineHandle step_, triangle_;
  ImageHandle target_;
  BufferHandle buffer_;
  CommandList* commands_ = nullptr;
};

TEST_F(CommandMisuse, work_without_a_pipeline) {
  EXPECT_ASSERT(commands_->dispatch(1, 1, 1), "a pipeline is bound first");
  EXPECT_ASSERT(commands_->bind({}), "a pipeline is bound first");
  EXPECT_ASSERT(commands_->push_constants({}), "a pipeline is bound first");
}

TEST_F(CommandMisuse, a_dispatch_without_bindings) {
  commands_->bind_pipeline(step_);
  EXPECT_ASSERT(commands_->dispatch(1, 1, 1), "pipeline \"step\" is used before its bindings are bound");
  EXPECT_ASSERT(commands_->bind({}), "\"step\"");
}

TEST_F(CommandMisuse, a_pipeline_of_the_other_kind) {
  commands_->bind_pipeline(triangle_);
  EXPECT_ASSERT(commands_->dispatch(1, 1, 1), "a dispatch needs a compute pipeline, and \"triangle\" draws");
  begin_rendering();
  commands_->bind_pipeline(step_);
  EXPECT_ASSERT(commands_->draw(3, 1, 0, 0), "a draw needs a graphics pipeline, and \"step\" computes");
}

TEST_F(CommandMisuse, a_draw_outside_rendering_or_without_its_resources) {
  commands_->bind_pipeline(triangle_);
  EXPECT_ASSERT(commands_->draw(3, 1, 0, 0), "a draw comes between begin_rendering and end_rendering");
  EXPECT_ASSERT(commands_->end_rendering(), "end_rendering needs begin_rendering before it");
  begin_rendering();
  EXPECT_ASSERT(begin_rendering(), "between begin_rendering and end_rendering");
  EXPECT_ASSERT(commands_->draw(3, 1, 0, 0), "pipeline \"triangle\" is used before its bindings are bound");
  const auto brightness = test::make_upload(*device_, std::vector<float>{1.0f});
  const auto tints = test::make_upload(*device_, std::vector<float>(8, 1.0f));
  commands_->bind(std::array{Binding{0, Binding::BufferRange{brightness}}});
  EXPECT_ASSERT(commands_->draw(3, 1, 0, 0), "pipeline \"triangle\" is used before its set 1 is bound");
  commands_->bind_set(1, test::value_of(device_->create_resource_set(
                             triangle_, 1, std::array{Binding{3, Binding::BufferRange{tints}}})));
  EXPECT_ASSERT(commands_->draw(3, 1, 0, 0), "pipeline \"triangle\" is used before its vertex stream 0 is bound");
  commands_->bind_vertex_stream(0, buffer_, 0);
  EXPECT_ASSERT(commands_->draw_indexed(3, 1, 0, 0, 0), "pipeline \"triangle\" is used before its indices are bound");
}

TEST_F(CommandMisuse, other_work_while_rendering) {
  begin_rendering();
  commands_->bind_pipeline(step_);
  EXPECT_ASSERT(commands_->dispatch(1, 1, 1), "a dispatch must not come between begin_rendering and end_rendering");
  EXPECT_ASSERT(commands_->fill_buffer(buffer_, 0, 16, 0), "a fill must not come between begin_rendering");
  EXPECT_ASSERT((void)device_->submit_frame(), "rendering is ended before the frame is submitted");
}

TEST_F(CommandMisuse, gloams_commands_amid_and_after_native_ones) {
  begin_rendering();
  commands_->bind_pipeline(triangle_);
  {
    const NativeCommands native = native_commands(*commands_);
    EXPECT_NE(native.get(), VkCommandBuffer{});
    EXPECT_ASSERT(commands_->bind_pipeline(triangle_),
                  "bind_pipeline must wait until the host's native commands have ended");
    EXPECT_ASSERT(commands_->draw(3, 1, 0, 0), "a pipeline is bound first");
    EXPECT_ASSERT(commands_->bind_indices(buffer_, 0), "bind_indices must wait");
    EXPECT_ASSERT(commands_->set_viewport(0, 0, 1, 1), "set_viewport must wait");
    EXPECT_ASSERT(commands_->set_scissor(0, 0, 1, 1), "set_scissor must wait");
    EXPECT_ASSERT(commands_->end_rendering(), "end_rendering must wait");
    EXPECT_ASSERT(commands_->fill_buffer(buffer_, 0, 16, 0), "a fill must wait");
    EXPECT_ASSERT((void)native_commands(*commands_), "native_commands must wait");
    EXPECT_ASSERT((void)device_->submit_frame(), "native commands are ended before the frame is submitted");
  }
  EXPECT_ASSERT(commands_->draw(3, 1, 0, 0), "a pipeline is bound first");
  EXPECT_ASSERT(commands_->bind({}), "a pipeline is bound first");
}

TEST_F(CommandMisuse, imported_buffers_that_are_not_described) {
  const VkBuffer theirs = native_buffer(*device_, buffer_);
  const BufferDesc desc{.name = "lent", .module = "test", .size = 1024, .usage = storage};
  EXPECT_ASSERT((void)import_buffer(*device_, VK_NULL_HANDLE, desc), "a buffer to import must exist");
  BufferDesc wrong = desc;
  wrong.size = 0;
  EXPECT_ASSERT((void)import_buffer(*device_, theirs, wrong), "states its size and usage");
  wrong = desc;
  wrong.memory = MemoryKind::upload;
  EXPECT_ASSERT((void)import_buffer(*device_, theirs, wrong), "gloam does not map a host's buffer");
  const BufferHandle imported = import_buffer(*device_, theirs, desc);
  EXPECT_TRUE(device_->is_foreign(imported));
  EXPECT_FALSE(device_->is_foreign(buffer_));
  EXPECT_ASSERT((void)device_->mapped(imported), "only upload and readback buffers are mapped");
  EXPECT_ASSERT(commands_->fill_buffer(imported, 1024, 16, 0), "a range stays inside buffer \"lent\"");
  device_->destroy(imported);
  commands_->fill_buffer(buffer_, 0, 16, 0);  // it is still there
}

TEST_F(CommandMisuse, objects_that_are_gone_or_too_small) {
  EXPECT_ASSERT(commands_->fill_buffer(buffer_, 1024, 16, 0), "a range stays inside buffer \"test storage\"");
  EXPECT_ASSERT((void)device_->mapped(buffer_), "only upload and readback buffers are mapped");
  device_->destroy(buffer_);
  EXPECT_ASSERT(commands_->fill_buffer(buffer_, 0, 16, 0), "this buffer is not alive");
  EXPECT_ASSERT(device_->destroy(buffer_), "this buffer is not alive");
  EXPECT_ASSERT((void)device_->desc(ImageHandle{77, 1}), "this image is not alive");
}

TEST_F(CommandMisuse, a_frame_begun_twice) {
  EXPECT_ASSERT((void)device_->begin_frame(), "a frame is submitted before the next one begins");
}

}  // namespace
}  // namespace gloam::gpu

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/play/display/upscaler.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>

#include "engine/gpu/recording/device.h"

namespace gloam {
namespace {

std::uint64_t bytes_of(const gpu::Device& device) {
  std::uint64_t bytes = 0;
  for (const gpu::ModuleMemory& memory : device.memory()) bytes += memory.bytes;
  return bytes;
}

TEST(UpscalerTest, keeps_one_image_of_the_last_size) {
  const auto device = gpu::make_recording_device();
  {
    Upscaler upscaler(*device);
    const auto first = upscaler.image(64, 36);
    ASSERT_TRUE(first.ok());
    const std::uint64_t bytes = bytes_of(*device);
    EXPECT_EQ(*upscaler.image(64, 36), *first);
    for (const std::uint32_t width : {32u, 80u, 20u, 64u}) ASSERT_TRUE(upscaler.image(width, 36).ok());
    EXPECT_EQ(bytes_of(*device), bytes);
    upscaler.release();
    EXPECT_EQ(bytes_of(*device), 0u);
    ASSERT_TRUE(upscaler.image(8, 8).ok());
  }
  EXPECT_EQ(bytes_of(*device), 0u);
  EXPECT_THAT(device->faults(), ::testing::IsEmpty());
}

TEST(UpscalerTest, declares_a_pass_an_axis_without_faults) {
  const auto device = gpu::make_recording_device();
  {
    Upscaler upscaler(*device);
    FrameGraph graph(*device);
    const auto image = upscaler.image(64, 36);
    ASSERT_TRUE(image.ok());
    const auto window = device->create_image({.name = "window",
                                              .module = "test",
                                              .format = gpu::Format::bgra8_unorm,
                                              .width = 160,
                                              .height = 90,
                                              .usage = gpu::ImageUsage::color_target});
    ASSERT_TRUE(window.ok());
    auto commands = device->begin_frame();
    ASSERT_TRUE(commands.ok());
    graph.begin();
    const ImageRef picture = graph.import_image("picture", *image, gpu::Access::none, gpu::Access::fragment_read);
    PassBuilder pass = graph.add_pass("drawn", "test");
    const ImageRef drawn = pass.write(picture, gpu::Access::color_target);
    pass.execute([drawn](PassContext& context) {
      context.commands().begin_rendering(
          {.colors = {{.view = {.image = context.image(drawn)}}}, .width = 64, .height = 36});
      context.commands().end_rendering();
    });
    ImageRef shown = graph.import_image("window", *window, gpu::Access::none, gpu::Access::color_target);
    ASSERT_TRUE(upscaler.add_passes(graph, drawn, shown).ok());
    ASSERT_TRUE(graph.compile().ok());
    graph.execute(**commands);
    ASSERT_TRUE(device->submit_frame().ok());
    ASSERT_TRUE(device->wait_idle().ok());
    device->destroy(*window);
  }
  EXPECT_EQ(device->pipeline_count("panel"), 0u);
  EXPECT_THAT(device->faults(), ::testing::IsEmpty());
}

}  // namespace
}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// Three-dimensional images.
#include <array>
#include <cmath>

#include "shaders/gpu_test/shaders.h"
#include "tests/gpu/vulkan/device_fixture.h"
#include "tests/support/expect_assert.h"

namespace gloam::gpu {
namespace {

using enum ImageUsage;

constexpr std::array<std::uint32_t, 3> kVolumeSize = {5, 3, 4};

class Volumes : public VulkanTest {
 protected:
  ImageHandle make_volume(ImageUsage usage, std::uint32_t mips = 1) {
    return test::value_of(device().create_image({.name = "volume",
                                                 .module = "test",
                                                 .format = Format::r32_float,
                                                 .width = kVolumeSize[0],
                                                 .height = kVolumeSize[1],
                                                 .mips = mips,
                                                 .usage = usage,
                                                 .shape = ImageShape::volume,
                                                 .depth = kVolumeSize[2]}));
  }
  PipelineHandle pipeline(const char* name, const ShaderCode& shader) {
    return test::value_of(device().create_pipeline({.name = name, .module = "test", .shader = shader}));
  }
  /// Writes x + 10 y + 100 z to each texel. Leaves the volume ready for compute_write.
  void paint(CommandList& commands, ImageHandle volume, PipelineHandle kernel) {
    to(commands, volume, Access::none, Access::compute_write);
    commands.bind_pipeline(kernel);
    commands.bind(std::array{Binding{0, Binding::Storage{{.image = volume}}}});
    commands.dispatch(2, 1, 1);
  }
};

/// The painted function at a position of 0 to 1 in each direction, filtered linearly and clamped to the edge texels.
double painted_at(const std::array<float, 3>& position) {
  constexpr std::array<double, 3> kWeights = {1.0, 10.0, 100.0};
  double value = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double texel = static_cast<double>(position[axis]) * kVolumeSize[axis] - 0.5;
    value += kWeights[axis] * std::clamp(texel, 0.0, kVolumeSize[axis] - 1.0);
  }
  return value;
}

TEST_F(Volumes, are_written_by_one_kernel_and_sampled_by_another) {
  const ImageHandle volume = make_volume(storage | sampled);
  const PipelineHandle paint_volume = pipeline("paint", shaders::gpu_test::paint_volume_comp);
  const PipelineHandle look = pipeline("look", shaders::gpu_test::look_into_volume_comp);
  std::vector<std::array<float, 3>> positions;
  for (std::uint32_t i = 0; i < 9 * 7 * 8; ++i) {
    // Texel centres, the middles between them and the borders.
    const std::array<std::uint32_t, 3> step = {i % 9, i / 9 % 7, i / 63};
    auto& position = positions.emplace_back();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      position[axis] = static_cast<float>(step[axis]) * 0.5f / static_cast<float>(kVolumeSize[axis]);
    }
  }
  const auto sampler = test::value_of(
      device().create_sampler({.address_u = AddressMode::clamp_to_edge, .address_v = AddressMode::clamp_to_edge}));
  const BufferHandle upload = test::make_upload(device(), positions);
  const BufferHandle seen = test::make_readback(device(), positions.size() * sizeof(float));
  test::run_frame(device(), [&](CommandList& commands) {
    paint(commands, volume, paint_volume);
    to(commands, volume, Access::compute_write, Access::compute_read);
    commands.bind_pipeline(look);
    commands.bind(std::array{Binding{0, Binding::Sampled{{.image = volume}, sampler}},
                             Binding{1, Binding::BufferRange{upload}}, Binding{2, Binding::BufferRange{seen}}});
    commands.dispatch(static_cast<std::uint32_t>(positions.size() + 63) / 64, 1, 1);
    to(commands, seen, Access::compute_write, Access::host_read);
  });
  const auto values = test::items_of<float>(device(), seen);
  for (std::size_t i = 0; i < positions.size(); ++i) EXPECT_NEAR(values[i], painted_at(positions[i]), 1e-3) << i;
}

TEST_F(Volumes, copies_hold_slice_after_slice_in_every_mip) {
  const ImageHandle painted = make_volume(storage | transfer_source);
  const ImageHandle copied = make_volume(transfer_source | transfer_target, 2);
  const PipelineHandle paint_volume = pipeline("paint", shaders::gpu_test::paint_volume_comp);
  const std::vector<float> small = {1.0f, 2.0f, 3.0f, 4.0f};  // 2 × 1 × 2 texels
  const BufferHandle upload = test::make_upload(device(), small);
  BufferHandle read_painted, read_small;
  test::run_frame(device(), [&](CommandList& commands) {
    paint(commands, painted, paint_volume);
    read_painted = read_layer(commands, painted, Access::compute_write);
    to(commands, copied, Access::none, Access::transfer_write);
    commands.copy_buffer_to_image(upload, 0, copied, 1, 0, 1);
    read_small = read_layer(commands, copied, Access::transfer_write, 0, 1);
  });
  EXPECT_EQ(test::items_of<float>(device(), read_small), small);
  const auto texels = test::items_of<float>(device(), read_painted);
  ASSERT_EQ(texels.size(), kVolumeSize[0] * kVolumeSize[1] * kVolumeSize[2]);
  for (std::uint32_t i = 0; i < texels.size(); ++i) {
    const std::uint32_t x = i % kVolumeSize[0], y = i / kVolumeSize[0] % kVolumeSize[1],
                        z = i / (kVolumeSize[0] * kVolumeSize[1]);
    EXPECT_EQ(texels[i], static_cast<float>(x + 10 * y + 100 * z));
  }
}

TEST_F(Volumes, blits_halve_all_three_sides) {
  const ImageHandle volume = make_volume(storage | transfer_source | transfer_target, 3);
  const PipelineHandle paint_volume = pipeline("paint", shaders::gpu_test::paint_volume_comp);
  BufferHandle read;
  test::run_frame(device(), [&](CommandList& commands) {
    paint(commands, volume, paint_volume);
    const ImageBarrier source{
        .image = volume, .before = Access::compute_write, .after = Access::transfer_read, .range = {.mip_count = 1}};
    const ImageBarrier target{
        .image = volume, .before = Access::compute_write, .after = Access::transfer_write, .range = {.first_mip = 1}};
    commands.barrier({}, std::array{source, target});
    commands.blit(volume, volume, {.mip = 0}, {.mip = 2});
    const ImageBarrier rest{
        .image = volume, .before = Access::transfer_read, .after = Access::transfer_write, .range = {.mip_count = 1}};
    commands.barrier({}, {&rest, 1});
    read = read_layer(commands, volume, Access::transfer_write, 0, 2);
  });
  // The centre of the whole volume lies on a texel in x and y, and between two slices in z.
  EXPECT_NEAR(test::items_of<float>(device(), read).at(0), 2.0 + 10.0 + 150.0, 1e-3);
}

TEST_F(Volumes, larger_than_the_device_allows_are_errors) {
  const auto made = device().create_image({.name = "deep",
                                           .module = "test",
                                           .format = Format::r8_unorm,
                                           .usage = sampled,
                                           .shape = ImageShape::volume,
                                           .depth = 1u << 20});
  ASSERT_FALSE(made.ok());
  EXPECT_NE(made.error().message.find("\"deep\" of module \"test\" (1x1x1048576"), std::string::npos)
      << made.error().message;
}

TEST_F(Volumes, misuse_asserts_with_a_sentence) {
  EXPECT_ASSERT((void)device().create_image({.name = "x", .format = Format::r8_unorm, .usage = sampled, .depth = 2}),
                "only a volume has a depth");
  EXPECT_ASSERT(
      (void)device().create_image(
          {.name = "x", .format = Format::r8_unorm, .usage = color_target, .shape = ImageShape::volume, .depth = 2}),
      "never a target");
  const ImageHandle volume = make_volume(storage | sampled);
  const PipelineHandle flat = pipeline("paint", shaders::gpu_test::paint_comp);
  test::run_frame(device(), [&](CommandList& commands) {
    to(commands, volume, Access::none, Access::compute_write);
    commands.bind_pipeline(flat);
    EXPECT_ASSERT(commands.bind(std::array{Binding{0, Binding::Storage{{.image = volume}}}}),
                  "\"target\" is no volume for the shader, unlike image \"volume\"");
  });
}

}  // namespace
}  // namespace gloam::gpu

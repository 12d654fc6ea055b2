// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/gpu/vulkan/resources/images.h"

#include <array>

#include "shaders/gpu_test/shaders.h"
#include "tests/gpu/vulkan/device_fixture.h"
#include "tests/support/expect_assert.h"

namespace gloam::gpu {
namespace {

using Texel = std::array<std::uint8_t, 4>;
using enum ImageUsage;

class Images : public VulkanTest {
 protected:
  ImageHandle make_image(ImageShape shape, std::uint32_t layers, ImageUsage usage) {
    return test::value_of(device().create_image({.name = "test image",
                                                 .module = "test",
                                                 .format = Format::rgba8_unorm,
                                                 .width = 16,
                                                 .height = 16,
                                                 .layers = layers,
                                                 .usage = usage,
                                                 .shape = shape}));
  }

  /// Records the kernel that writes (x, y, layer, 255) to each texel. Leaves the image ready for compute_write.
  void paint(CommandList& commands, ImageHandle image) {
    if (!paint_) {
      paint_ = test::value_of(
          device().create_pipeline({.name = "paint", .module = "test", .shader = shaders::gpu_test::paint_comp}));
    }
    to(commands, image, Access::none, Access::compute_write);
    commands.bind_pipeline(paint_);
    commands.bind(std::array{Binding{0, Binding::Storage{{.image = image}}}});
    commands.dispatch(2, 2, device().desc(image).layers);
  }

  PipelineHandle paint_;
};

TEST_F(Images, a_kernel_writes_all_layers_and_a_copy_reads_them) {
  const ImageHandle image = make_image(ImageShape::array, 3, storage | transfer_source);
  BufferHandle read;
  test::run_frame(device(), [&](CommandList& commands) {
    paint(commands, image);
    read = read_layer(commands, image, Access::compute_write, 2);
  });
  const auto texels = test::items_of<Texel>(device(), read);
  ASSERT_EQ(texels.size(), 256u);
  for (std::uint8_t y = 0; y < 16; ++y) {
    for (std::uint8_t x = 0; x < 16; ++x) EXPECT_EQ(texels[y * 16 + x], (Texel{x, y, 2, 255}));
  }
}

TEST_F(Images, shaders_sample_planes_layers_cubes_and_arrays_of_cubes) {
  const ImageHandle plane = make_image(ImageShape::plain, 1, storage | sampled);
  const ImageHandle cubes = make_image(ImageShape::cube, 12, storage | sampled);
  const auto sampler = test::value_of(device().create_sampler({.min_filter = Filter::nearest,
                                                               .mag_filter = Filter::nearest,
                                                               .address_u = AddressMode::clamp_to_edge,
                                                               .address_v = AddressMode::clamp_to_edge}));
  const auto look = test::value_of(
      device().create_pipeline({.name = "look", .module = "test", .shader = shaders::gpu_test::look_comp}));
  const BufferHandle seen = test::make_readback(device(), 64);
  test::run_frame(device(), [&](CommandList& commands) {
    paint(commands, plane);
    paint(commands, cubes);
    to(commands, plane, Access::compute_write, Access::compute_read);
    to(commands, cubes, Access::compute_write, Access::compute_read);
    commands.bind_pipeline(look);
    commands.bind(std::array{
        Binding{0, Binding::Sampled{{.image = plane}, sampler}},
        Binding{1, Binding::Sampled{{.image = cubes, .first_layer = 1, .layer_count = 7}, sampler}},
        Binding{2, Binding::Sampled{{.image = cubes, .first_layer = 0, .layer_count = 6}, sampler}},
        Binding{3, Binding::Sampled{{.image = cubes}, sampler}},
        Binding{4, Binding::BufferRange{seen}},
    });
    commands.push(std::array<std::uint32_t, 3>{5, 9, 4});
    commands.dispatch(1, 1, 1);
    to(commands, seen, Access::compute_write, Access::host_read);
  });
  const auto values = test::items_of<std::array<float, 4>>(device(), seen);
  const auto byte = [&](int view, int channel) { return static_cast<int>(values[view][channel] * 255.0f + 0.5f); };
  EXPECT_EQ(byte(0, 0), 5);
  EXPECT_EQ(byte(0, 1), 9);
  EXPECT_EQ(byte(0, 2), 0);
  EXPECT_EQ(byte(1, 0), 5);
  EXPECT_EQ(byte(1, 2), 5);  // layer 4 of a view that begins at layer 1
  EXPECT_EQ(byte(2, 2), 5);  // -Z is the sixth face
  EXPECT_EQ(byte(3, 2), 11);
}

TEST_F(Images, a_kernel_may_sample_one_mip_and_write_the_next_of_one_image) {
  const auto image =
      test::value_of(device().create_image({.name = "mips",
                                            .module = "test",
                                            .format = Format::r32_float,
                                            .width = 4,
                                            .height = 4,
                                            .mips = 3,
                                            .usage = storage | sampled | transfer_source | transfer_target}));
  std::vector<float> base(16);
  for (std::size_t i = 0; i < base.size(); ++i) base[i] = static_cast<float>(i);
  const BufferHandle upload = test::make_upload(device(), base);
  const auto sampler = test::value_of(
      device().create_sampler({.address_u = AddressMode::clamp_to_edge, .address_v = AddressMode::clamp_to_edge}));
  const auto halve = test::value_of(
      device().create_pipeline({.name = "halve", .module = "test", .shader = shaders::gpu_test::halve_comp}));
  BufferHandle read;
  test::run_frame(device(), [&](CommandList& commands) {
    to(commands, image, Access::none, Access::transfer_write);
    commands.copy_buffer_to_image(upload, 0, image, 0, 0, 1);
    to(commands, image, Access::transfer_write, Access::compute_write);
    commands.bind_pipeline(halve);
    for (std::uint32_t mip = 1; mip < 3; ++mip) {
      commands.bind(
          std::array{Binding{0, Binding::Sampled{{.image = image, .first_mip = mip - 1, .mip_count = 1}, sampler}},
                     Binding{1, Binding::Storage{{.image = image, .first_mip = mip}}}});
      commands.dispatch(1, 1, 1);
      to(commands, image, Access::compute_write, Access::compute_write);
    }
    read = read_layer(commands, image, Access::compute_write, 0, 2);
  });
  EXPECT_FLOAT_EQ(test::items_of<float>(device(), read).at(0), 7.5f);
}

TEST_F(Images, a_kernel_samples_drawn_depth_and_reads_and_writes_images_of_one_channel) {
  const auto make = [&](const char* name, Format format, ImageUsage usage) {
    return test::value_of(device().create_image(
        {.name = name, .module = "test", .format = format, .width = 16, .height = 16, .usage = usage}));
  };
  const ImageHandle depth = make("depth", Format::d32_float, depth_target | sampled);
  const ImageHandle exact = make("exact", Format::r32_float, storage | sampled | transfer_source | transfer_target);
  const ImageHandle rounded = make("rounded", Format::r16_unorm, storage | sampled | transfer_source | transfer_target);
  const auto sampler = test::value_of(device().create_sampler(
      {.min_filter = Filter::nearest, .mag_filter = Filter::nearest, .mip_filter = Filter::nearest}));
  const auto add = test::value_of(device().create_pipeline(
      {.name = "add in place", .module = "test", .shader = shaders::gpu_test::add_in_place_comp}));
  std::vector<float> floats(256);
  std::vector<std::uint16_t> words(256);
  for (std::uint16_t i = 0; i < 256; ++i) {
    floats[i] = static_cast<float>(i);
    words[i] = static_cast<std::uint16_t>(100 * i);
  }
  const BufferHandle upload_floats = test::make_upload(device(), floats);
  const BufferHandle upload_words = test::make_upload(device(), words);
  BufferHandle read_exact, read_rounded;
  test::run_frame(device(), [&](CommandList& commands) {
    to(commands, depth, Access::none, Access::depth_target);
    RenderingDesc rendering;
    rendering.depth = {.view = {.image = depth}, .load = LoadOp::clear, .clear = 0.25f};
    rendering.width = rendering.height = 16;
    commands.begin_rendering(rendering);
    commands.end_rendering();
    to(commands, depth, Access::depth_target, Access::compute_read);
    for (const auto& [image, buffer] : {std::pair{exact, upload_floats}, std::pair{rounded, upload_words}}) {
      to(commands, image, Access::none, Access::transfer_write);
      commands.copy_buffer_to_image(buffer, 0, image, 0, 0, 1);
      to(commands, image, Access::transfer_write, Access::compute_write);
    }
    commands.bind_pipeline(add);
    commands.bind(std::array{Binding{0, Binding::Sampled{{.image = depth}, sampler}},
                             Binding{1, Binding::Storage{{.image = exact}}},
                             Binding{2, Binding::Storage{{.image = rounded}}}});
    commands.dispatch(2, 2, 1);
    read_exact = read_layer(commands, exact, Access::compute_write);
    read_rounded = read_layer(commands, rounded, Access::compute_write);
  });
  const auto sums = test::items_of<float>(device(), read_exact);
  const auto rounded_sums = test::items_of<std::uint16_t>(device(), read_rounded);
  for (std::size_t i = 0; i < 256; ++i) {
    EXPECT_EQ(sums.at(i), static_cast<float>(i) + 0.25f);
    EXPECT_NEAR(rounded_sums.at(i), 100.0 * static_cast<double>(i) + 0.25 * 65535.0, 1.0);
  }
}

TEST_F(Images, clears_write_the_given_bits_and_blits_scale) {
  const ImageHandle small = make_image(ImageShape::plain, 1, transfer_source | transfer_target);
  const auto large = test::value_of(device().create_image({.name = "large",
                                                           .module = "test",
                                                           .format = Format::rgba8_unorm,
                                                           .width = 64,
                                                           .height = 32,
                                                           .usage = transfer_source | transfer_target}));
  BufferHandle read;
  test::run_frame(device(), [&](CommandList& commands) {
    to(commands, small, Access::none, Access::transfer_write);
    commands.clear_color_image(small, {0x3f800000u, 0u, 0x3f800000u, 0x3f800000u});  // 1, 0, 1, 1 as floats
    to(commands, small, Access::transfer_write, Access::transfer_read);
    to(commands, large, Access::none, Access::transfer_write);
    commands.blit(small, large);
    read = read_layer(commands, large, Access::transfer_write);
  });
  const auto texels = test::items_of<Texel>(device(), read);
  ASSERT_EQ(texels.size(), 64u * 32u);
  for (const Texel& texel : texels) ASSERT_EQ(texel, (Texel{255, 0, 255, 255}));
}

TEST_F(Images, aliased_images_share_memory_that_is_counted_once) {
  const ImageDesc a = {.name = "a",
                       .module = "first",
                       .format = Format::rgba16_float,
                       .width = 128,
                       .height = 128,
                       .usage = transfer_source | transfer_target};
  ImageDesc b = a;
  b.name = "b";
  b.module = "second";
  b.format = Format::rgba8_unorm;
  const auto alone = test::value_of(device().create_image(a));
  const std::uint64_t bytes = bytes_of("first");
  EXPECT_GE(bytes, 128u * 128u * 8u);
  const auto images = test::value_of(device().create_aliased_images(std::array{a, b}));
  ASSERT_EQ(images.size(), 2u);
  EXPECT_EQ(bytes_of("first"), 2 * bytes);
  EXPECT_EQ(bytes_of("second"), 0u);

  BufferHandle read_a;
  BufferHandle read_b;
  test::run_frame(device(), [&](CommandList& commands) {
    to(commands, images[0], Access::none, Access::transfer_write);
    commands.clear_color_image(images[0], {0x3f800000u, 0x3f800000u, 0x3f800000u, 0x3f800000u});
    read_a = read_layer(commands, images[0], Access::transfer_write);
    const ImageBarrier reuse = {
        .image = images[1], .after = Access::transfer_write, .also_before = mask_of(Access::transfer_read)};
    commands.barrier({}, {&reuse, 1});
    commands.clear_color_image(images[1], {0u, 0u, 0u, 0x3f800000u});
    read_b = read_layer(commands, images[1], Access::transfer_write);
  });
  EXPECT_EQ(test::items_of<std::uint16_t>(device(), read_a).at(0), 0x3c00);
  EXPECT_EQ(test::items_of<Texel>(device(), read_b).at(0), (Texel{0, 0, 0, 255}));
  device().destroy(images[0]);
  EXPECT_EQ(bytes_of("first"), 2 * bytes);  // the other image still uses the memory
  device().destroy(images[1]);
  device().destroy(alone);
  EXPECT_EQ(bytes_of("first"), 0u);
}

TEST_F(Images, limits_and_formats_are_errors_that_name_the_image) {
  const auto wide = device().create_image(
      {.name = "wide", .module = "test", .format = Format::rgba8_unorm, .width = 1u << 20, .usage = sampled});
  ASSERT_FALSE(wide.ok());
  EXPECT_NE(wide.error().message.find("\"wide\""), std::string::npos) << wide.error().message;
  EXPECT_NE(wide.error().message.find("texels a side"), std::string::npos) << wide.error().message;
  const auto odd =
      device().create_image({.name = "odd", .module = "test", .format = Format::d32_float, .usage = storage});
  ASSERT_FALSE(odd.ok());
  EXPECT_NE(odd.error().message.find("cannot use this format"), std::string::npos) << odd.error().message;
}

TEST_F(Images, are_made_exactly_for_the_uses_that_the_device_supports) {
  constexpr std::array kUses = {transfer_source, transfer_target, sampled, storage, color_target, depth_target};
  std::uint32_t supported = 0;
  for (int f = 1; f <= static_cast<int>(Format::d32_float); ++f) {
    const auto format = static_cast<Format>(f);
    for (const ImageUsage use : kUses) {
      const auto made = device().create_image(
          {.name = "any", .module = "test", .format = format, .width = 4, .height = 4, .usage = use});
      EXPECT_EQ(made.ok(), device().supports(format, use)) << name_of(format) << " " << text_of(use);
      supported += made.ok() ? 1 : 0;
      if (made.ok()) device().destroy(*made);
    }
  }
  EXPECT_GT(supported, 60u);
  EXPECT_TRUE(device().supports(Format::rgba16_float, sampled | storage | color_target));
  EXPECT_FALSE(device().supports(Format::rgba16_float, depth_target));
  EXPECT_FALSE(device().supports(Format::d32_float, sampled | storage));
  EXPECT_TRUE(device().supports_blit(Format::rgba16_float));
  EXPECT_FALSE(device().supports_blit(Format::d32_float));
  EXPECT_FALSE(device().supports_blit(Format::r32_uint));
}

TEST_F(Images, misuse_asserts_with_a_sentence) {
  const ImageHandle image = make_image(ImageShape::array, 2, storage | transfer_source | transfer_target);
  EXPECT_ASSERT((void)device().create_image({.name = "x", .format = Format::r8_unorm, .layers = 2, .usage = sampled}),
                "plain image has one layer");
  test::run_frame(device(), [&](CommandList& commands) {
    EXPECT_ASSERT(commands.clear_color_image(image, {}), "must be in transfer_write");
    EXPECT_ASSERT(to(commands, image, Access::none, Access::none), "must lead to an access");
  });
}

}  // namespace
}  // namespace gloam::gpu

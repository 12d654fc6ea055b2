// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>

#include <bit>
#include <cmath>
#include <random>

#include "engine/frame/mip_chain_passes.h"
#include "engine/frame/transfers/readback.h"
#include "engine/frame/transfers/upload.h"
#include "engine/gpu/image_size.h"
#include "tests/support/gpu_device.h"

namespace gloam::test {
namespace {

using gpu::Access;
using gpu::ImageDesc;
using gpu::ImageShape;
using Floats = std::vector<float>;

/// The mean of 2×2 texels in double precision. The last row or column of an odd size is left out, and a side of one
/// texel counts twice.
Floats halved(const Floats& texels, std::uint32_t width, std::uint32_t height) {
  const std::uint32_t w = std::max(width / 2, 1u), h = std::max(height / 2, 1u);
  Floats result;
  for (std::uint32_t y = 0; y < h; ++y) {
    for (std::uint32_t x = 0; x < w; ++x) {
      double sum = 0.0;
      for (std::uint32_t i = 0; i < 4; ++i) {
        const std::uint32_t sx = std::min(2 * x + i % 2, width - 1), sy = std::min(2 * y + i / 2, height - 1);
        sum += texels[sy * width + sx];
      }
      result.push_back(static_cast<float>(sum / 4.0));
    }
  }
  return result;
}

/// A real device; any validation message fails the test.
class MipChainGpuTest : public testing::Test {
 public:
  void SetUp() override {
    GLOAM_REQUIRE_GPU(device);
    sampler = value_of(device->create_sampler({}));
  }
  void TearDown() override {
    if (device != nullptr) {
      EXPECT_EQ(device->validation_messages(), 0u);
    }
  }
  static ImageDesc desc_of(gpu::Format format, std::uint32_t width, std::uint32_t height, ImageShape shape,
                           std::uint32_t layers) {
    ImageDesc desc = {.name = "chain", .module = "test", .format = format, .width = width, .height = height};
    desc.layers = layers;
    desc.shape = shape;
    desc.mips = gpu::full_mip_count(desc);
    return desc;
  }
  /// The bytes of every mip of every layer (by layer, then mip) after the chain was filled from `texels` (all layers).
  std::vector<std::vector<std::byte>> filled(const ImageDesc& desc, std::span<const std::byte> texels,
                                             MipFilter filter) {
    const gpu::BufferHandle upload = make_upload(*device, texels);
    gpu::PipelineHandle kernel;
    if (filter == MipFilter::box) {
      kernel = value_of(device->create_pipeline(gpu::ComputePipelineDesc{
          .name = "halve", .module = "test", .shader = mip_chain_shader(desc.format).value()}));
    }
    FrameGraph graph(*device);
    Readback readback(*device);
    std::vector<ReadbackTicket> tickets;
    const gpu::ImageRange first_mip{.mip_count = 1};
    run_frame(*device, [&](gpu::CommandList& commands) {
      graph.begin();
      PassBuilder pass = graph.add_pass("upload", "test");
      const ImageRef image = pass.write(graph.create_image(desc), Access::transfer_write, first_mip);
      pass.execute([&, image](PassContext& context) {
        context.commands().copy_buffer_to_image(upload, 0, context.image(image), 0, 0, desc.layers);
      });
      const ImageRef chain = add_mip_chain(graph, {.name = "halve",
                                                   .module = "test",
                                                   .image = image,
                                                   .filter = filter,
                                                   .pipeline = kernel,
                                                   .sampler = sampler});
      for (std::uint32_t layer = 0; layer < desc.layers; ++layer) {
        for (std::uint32_t mip = 0; mip < desc.mips; ++mip) {
          tickets.push_back(value_of(readback.read_image(graph, chain, mip, layer)));
        }
      }
      const Status compiled = graph.compile();
      ASSERT_TRUE(compiled.ok()) << compiled.error().message;
      graph.execute(commands);
    });
    std::vector<std::vector<std::byte>> mips;
    for (const ReadbackTicket ticket : tickets) mips.push_back(readback.take(ticket).value());
    if (kernel) device->destroy(kernel);
    return mips;
  }
  [[nodiscard]] static Floats floats_of(const std::vector<std::byte>& bytes) {
    Floats floats(bytes.size() / sizeof(float));
    std::memcpy(floats.data(), bytes.data(), bytes.size());
    return floats;
  }
  static Floats random_floats(std::size_t count) {
    std::mt19937 random(11);
    Floats floats(count);
    for (float& f : floats) f = static_cast<float>(random() % 4096) / 16.0f;
    return floats;
  }

  std::unique_ptr<gpu::Device> device = make_test_device();
  gpu::SamplerHandle sampler;
};

TEST_F(MipChainGpuTest, both_filters_are_the_mean_of_four_texels_on_planes_layers_and_cube_faces) {
  struct Case {
    std::uint32_t width, height, layers;
    ImageShape shape;
  };
  for (const Case& c :
       {Case{32, 16, 1, ImageShape::plain}, Case{8, 32, 3, ImageShape::array}, Case{16, 16, 6, ImageShape::cube}}) {
    const ImageDesc desc = desc_of(gpu::Format::r32_float, c.width, c.height, c.shape, c.layers);
    const std::size_t texels_a_layer = std::size_t{c.width} * c.height;
    const Floats texels = random_floats(texels_a_layer * c.layers);
    for (const MipFilter filter : {MipFilter::box, MipFilter::blit}) {
      ASSERT_TRUE(supports_mip_chain(*device, desc.format, filter));
      const auto mips = filled(desc, std::as_bytes(std::span(texels)), filter);
      for (std::uint32_t layer = 0; layer < c.layers; ++layer) {
        const auto begin = texels.begin() + static_cast<std::ptrdiff_t>(layer * texels_a_layer);
        Floats expected(begin, begin + static_cast<std::ptrdiff_t>(texels_a_layer));
        for (std::uint32_t mip = 0; mip < desc.mips; ++mip) {
          const Floats seen = floats_of(mips[layer * desc.mips + mip]);
          ASSERT_EQ(seen.size(), expected.size());
          for (std::size_t i = 0; i < seen.size(); ++i) {
            ASSERT_NEAR(seen[i], expected[i], 1e-4 * 256.0) << "layer " << layer << ", mip " << mip << ", texel " << i;
          }
          expected = halved(expected, std::max(c.width >> mip, 1u), std::max(c.height >> mip, 1u));
        }
      }
    }
  }
}

TEST_F(MipChainGpuTest, both_filters_agree_within_one_step_of_eight_bits_a_mip) {
  const ImageDesc desc = desc_of(gpu::Format::rgba8_unorm, 64, 64, ImageShape::array, 2);
  std::mt19937 random(5);
  std::vector<std::byte> texels(std::size_t{64} * 64 * 4 * 2);
  for (std::byte& b : texels) b = static_cast<std::byte>(random());
  const auto by_box = filled(desc, texels, MipFilter::box);
  const auto by_blit = filled(desc, texels, MipFilter::blit);
  ASSERT_EQ(by_box.size(), by_blit.size());
  for (std::size_t i = 0; i < by_box.size(); ++i) {
    const auto mip = static_cast<int>(i % desc.mips);  // each mip may add one rounding
    for (std::size_t b = 0; b < by_box[i].size(); ++b) {
      ASSERT_LE(std::abs(static_cast<int>(by_box[i][b]) - static_cast<int>(by_blit[i][b])), mip) << i << " " << b;
    }
  }
}

TEST_F(MipChainGpuTest, the_box_filter_leaves_out_the_last_row_and_column_of_odd_sizes) {
  const ImageDesc desc = desc_of(gpu::Format::r32_float, 21, 7, ImageShape::plain, 1);
  const Floats texels = random_floats(21 * 7);
  const auto mips = filled(desc, std::as_bytes(std::span(texels)), MipFilter::box);
  Floats expected = texels;
  for (std::uint32_t mip = 0; mip < desc.mips; ++mip) {
    EXPECT_THAT(floats_of(mips[mip]), testing::Pointwise(testing::FloatNear(1e-3f), expected)) << "mip " << mip;
    expected = halved(expected, std::max(21u >> mip, 1u), std::max(7u >> mip, 1u));
  }
}

TEST_F(MipChainGpuTest, every_kernel_fits_its_format) {
  int tried = 0;
  for (int f = 1; f <= static_cast<int>(gpu::Format::d32_float); ++f) {
    const auto format = static_cast<gpu::Format>(f);
    if (!supports_mip_chain(*device, format, MipFilter::box)) continue;
    ++tried;
    const ImageDesc desc = desc_of(format, 8, 4, ImageShape::plain, 1);
    const std::vector<std::byte> zeros(gpu::mip_bytes(desc, 0));
    for (const auto& mip : filled(desc, zeros, MipFilter::box)) EXPECT_THAT(mip, testing::Each(std::byte{0}));
  }
  EXPECT_GE(tried, 6);
}

}  // namespace
}  // namespace gloam::test

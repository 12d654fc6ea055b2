// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/frame/transfers/upload.h"
#include "engine/math/packing.h"
#include "shaders/lighting/lighting_shared.h"
#include "shaders/lighting/probes_shared.h"
#include "shaders/reflections/shaders.h"
#include "tests/modules/reflections/support/synthetic_view.h"
#include "tests/support/kernel.h"

namespace gloam::test {

using HalfTexel = std::array<std::uint16_t, 4>;
using ByteTexel = std::array<std::uint8_t, 4>;

[[nodiscard]] inline vec4 from_half(const HalfTexel& t) {
  return {half_to_float(t[0]), half_to_float(t[1]), half_to_float(t[2]), half_to_float(t[3])};
}
[[nodiscard]] inline HalfTexel to_half(const vec4& v) {
  return {float_to_half(v.x), float_to_half(v.y), float_to_half(v.z), float_to_half(v.w)};
}
[[nodiscard]] inline std::vector<vec4> from_half(const std::vector<HalfTexel>& texels) {
  std::vector<vec4> values;
  values.reserve(texels.size());
  for (const HalfTexel& texel : texels) values.push_back(from_half(texel));
  return values;
}

/// Binds what mirror_surface_api.glsl needs, with all tiles in the list, and runs the kernel. list: its first binding.
inline void run_over_tiles(Kernel& kernel, const shaders::ReflectionConstants& constants, std::uint32_t list) {
  const uvec2 tiles = (constants.size + 7u) / 8u;
  std::vector<std::uint32_t> places;
  for (std::uint32_t y = 0; y < tiles.y; ++y)
    for (std::uint32_t x = 0; x < tiles.x; ++x) places.push_back(x | y << 16);
  const auto count = static_cast<std::uint32_t>(places.size());
  const std::uint32_t rows = (count + GLOAM_TILE_ROW - 1) / GLOAM_TILE_ROW;
  kernel.input(list, std::vector{shaders::MirrorCommands{GLOAM_TILE_ROW, rows, 1, count}});
  kernel.input(list + 1, places);
  kernel.run(GLOAM_TILE_ROW, rows);
}

/// An image array whose layers have one value each, in all mips. Destroyed with the object.
class FlatLayers {
 public:
  FlatLayers(gpu::Device& device, std::uint32_t side, std::uint32_t mips, const std::vector<vec4>& colors)
      : FlatLayers(device, side, mips, static_cast<std::uint32_t>(colors.size()), texels_of(side, mips, colors)) {}
  /// texels: layer by layer, mip by mip.
  FlatLayers(gpu::Device& device, std::uint32_t side, std::uint32_t mips, std::uint32_t layers,
             const std::vector<HalfTexel>& texels)
      : device_(device) {
    gpu::ImageDesc desc{.name = "test layers", .module = "test", .format = gpu::Format::rgba16_float};
    desc.width = desc.height = side;
    desc.layers = layers;
    desc.mips = mips;
    desc.usage = gpu::ImageUsage::sampled | gpu::ImageUsage::transfer_target;
    desc.shape = gpu::ImageShape::array;
    image_ = value_of(device.create_image(desc));
    Uploader uploader(device);
    const auto bytes = std::as_bytes(std::span(texels));
    uploader.image(image_, {bytes.begin(), bytes.end()}, gpu::Access::compute_read);
    EXPECT_TRUE(uploader.flush().ok());
  }
  ~FlatLayers() {
    static_cast<void>(device_.wait_idle());
    device_.destroy(image_);
  }
  FlatLayers(const FlatLayers&) = delete;
  FlatLayers& operator=(const FlatLayers&) = delete;
  [[nodiscard]] gpu::ImageHandle image() const { return image_; }

 private:
  static std::vector<HalfTexel> texels_of(std::uint32_t side, std::uint32_t mips, const std::vector<vec4>& colors) {
    std::vector<HalfTexel> texels;
    for (const vec4& color : colors)
      for (std::uint32_t mip = 0; mip < mips; ++mip)
        texels.insert(texels.end(), std::size_t{side >> mip} * (side >> mip), to_half(color));
    return texels;
  }

  gpu::Device& device_;
  gpu::ImageHandle image_;
};

/// Binds what surroundings_api.glsl declares, for a world without probes and without light of the sky.
inline void bind_no_surroundings(Kernel& kernel, std::uint32_t environment, const FlatLayers& no_probes) {
  kernel.input(environment, std::vector<shaders::EnvironmentConstants>(1));
  kernel.input(24, std::vector{shaders::SurroundingsConstants{.fog_through = 1.0f}});
  kernel.input(25, std::vector<shaders::ProbeRow>(1));
  kernel.sampled_image(26, no_probes.image(), gpu::Filter::linear);
  kernel.input(27, std::vector<vec4>(1));
}

/// The mirror surfaces of a view, as passes/surroundings.comp finds them, by texel.
[[nodiscard]] inline std::vector<uvec2> find_mirrors(gpu::Device& device, const SyntheticView& seen,
                                                     const shaders::ReflectionConstants& constants) {
  const std::uint32_t w = seen.view.width, h = seen.view.height;
  const FlatLayers no_probes(device, 1, 1, {vec4(0.0f)});
  Kernel kernel(device, shaders::reflections::surroundings_comp);
  kernel.input(0, std::vector{view_constants(seen.view)});
  kernel.input(1, std::vector{constants});
  kernel.sampled_image(2, gpu::Format::rgba8_unorm, w, h, std::vector<std::uint32_t>(seen.depth.size()));
  kernel.sampled_image(3, gpu::Format::rg32_uint, w, h, seen.normals);
  kernel.sampled_image(4, gpu::Format::rgba8_unorm, w, h, seen.material);
  kernel.sampled_image(5, gpu::Format::r32_float, w, h, seen.depth);
  bind_no_surroundings(kernel, 6, no_probes);
  for (const std::uint32_t binding : {7u, 8u}) kernel.output_image(binding, gpu::Format::rgba16_float, w, h);
  kernel.output_image(11, gpu::Format::rg32_uint, constants.size.x, constants.size.y);
  const uvec2 tiles = (constants.size + 7u) / 8u;
  for (const std::uint32_t binding : {13u, 14u}) kernel.output(binding, std::uint64_t{4} * tiles.x * tiles.y);
  run_over_tiles(kernel, constants, 9);
  return kernel.read<uvec2>(11);
}

}  // namespace gloam::test

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "shaders/reflections/shaders.h"
#include "tests/modules/reflections/support/proxy_world.h"
#include "tests/modules/reflections/support/reflection_kernel.h"

namespace gloam::test {

/// Inputs of the kernel that blends screen space and proxies. Empty lists stand for missing inputs.
struct BlendInput {
  const SyntheticView& seen;
  shaders::ReflectionConstants constants{.unit_m = 1.0f};
  bool proxies_on = true;
  std::uint32_t layers = 4;
  bool sphere_test = true;
  bool naive = false;
  bool sort = true;
  bool pixel_normals = false;
  std::vector<vec4> ssr_color;         ///< by texel: radiance, confidence
  std::vector<float> ssr_distance_m;   ///< by texel
  std::vector<CaptureFactor> factors;  ///< by layer
  std::vector<vec4> cells;             ///< CaptureFactors::cells()
};

/// Its outputs, by texel.
struct Blended {
  std::vector<vec4> color;
  std::vector<ByteTexel> surface;
  [[nodiscard]] double distance_m(std::size_t texel) const {
    return (surface[texel][2] + 256.0 * surface[texel][3]) / 100.0;
  }
};

[[nodiscard]] inline BlendInput blend_input(const SyntheticView& seen, std::uint32_t scale = 1) {
  return {.seen = seen,
          .constants = reflection_constants(seen.view, scale),
          .ssr_color = {},
          .ssr_distance_m = {},
          .factors = {},
          .cells = {}};
}

/// Runs the kernel with rows and masks. colors: premultiplied image of each layer.
[[nodiscard]] inline Blended blend(gpu::Device& device, const BlendInput& in, std::vector<shaders::ProxyRow> rows,
                                   const ProxyTiles& tiles, const FlatLayers& images) {
  const shaders::ReflectionConstants& c = in.constants;
  const std::size_t texels = std::size_t{c.size.x} * c.size.y;
  Kernel kernel(device, shaders::reflections::proxy_blending_comp,
                {{"kScreenSpace", in.ssr_color.empty() ? 0u : 1u},
                 {"kProxies", in.proxies_on ? 1u : 0u},
                 {"kLayers", in.layers},
                 {"kSphereTest", in.sphere_test ? 1u : 0u},
                 {"kNaive", in.naive ? 1u : 0u},
                 {"kPixelRoughness", c.pixel_roughness},
                 {"kSort", in.sort ? 1u : 0u},
                 {"kPixelNormals", in.pixel_normals ? 1u : 0u}});
  kernel.input(0, std::vector{view_constants(in.seen.view)});
  kernel.input(1, std::vector{c});
  kernel.sampled_image(2, gpu::Format::rg32_uint, c.size.x, c.size.y, find_mirrors(device, in.seen, c));
  std::vector<vec4> ssr = in.ssr_color;
  ssr.resize(texels, vec4(0.0f));
  std::vector<ByteTexel> distances(texels, ByteTexel{});
  for (std::size_t i = 0; i < in.ssr_distance_m.size(); ++i) {
    const auto cm = static_cast<std::uint32_t>(std::lround(in.ssr_distance_m[i] * 100.0f));
    distances[i] = {static_cast<std::uint8_t>(cm % 256), static_cast<std::uint8_t>(cm / 256), 0, 0};
  }
  kernel.sampled_image(5, gpu::Format::rgba32_float, c.size.x, c.size.y, ssr);
  kernel.sampled_image(6, gpu::Format::rgba8_unorm, c.size.x, c.size.y, distances);
  const auto count = static_cast<std::uint32_t>(rows.size());
  if (rows.empty()) rows.resize(1);
  kernel.input(7, rows);
  kernel.input(8, tiles.masks.empty() ? std::vector<std::uint32_t>{0} : tiles.masks);
  kernel.sampled_image(9, images.image(), gpu::Filter::linear);
  kernel.input(10, in.cells.empty() ? std::vector<vec4>(1) : in.cells);
  kernel.sampled_image(11, gpu::Format::rg32_uint, in.seen.view.width, in.seen.view.height, in.seen.normals);
  kernel.input(12, std::vector{shaders::ProxyTileConstants{tiles.tiles, tiles.words_per_tile, count, 0}});
  kernel.output_image(13, gpu::Format::rgba16_float, c.size.x, c.size.y);
  kernel.output_image(14, gpu::Format::rgba8_unorm, c.size.x, c.size.y);
  run_over_tiles(kernel, c, 3);
  return {from_half(kernel.read<HalfTexel>(13)), kernel.read<ByteTexel>(14)};
}
[[nodiscard]] inline Blended blend(gpu::Device& device, const BlendInput& in, const ProxyWorld& world,
                                   const FlatLayers& images, ProxyTileSettings settings = {}) {
  settings.columns = in.constants.size.x;
  const ProxyTiles tiles = world.tiles(in.seen.view, settings);
  BlendInput with_cells = in;
  auto rows =
      proxy_rows(world.world, in.seen.view, world.set, tiles, world.captures, in.factors, in.naive, with_cells.cells);
  return blend(device, with_cells, std::move(rows), tiles, images);
}

/// Proxies about the origin that face anywhere.
[[nodiscard]] inline ProxyScene random_proxies(ProxyRandom& random, int count) {
  ProxyScene scene;
  for (int i = 0; i < count; ++i) {
    const dvec3 center(random.between(-8.0, 8.0), random.between(-0.5, 5.0), random.between(-10.0, 8.0));
    const dvec3 toward = random.one_in(3) ? random.direction() : dvec3(random.between(-1.0, 1.0), 0.0, 1.0);
    const double wide = random.length(-0.5, 0.8), high = random.length(-0.5, 0.6);
    scene.add(center, toward, {static_cast<float>(wide), static_cast<float>(high)});
  }
  return scene;
}

}  // namespace gloam::test

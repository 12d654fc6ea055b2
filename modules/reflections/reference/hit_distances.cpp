// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/reference/hit_distances.h"

#include <algorithm>
#include <utility>

#include "engine/render/kernel_check/kernel_run.h"
#include "shaders/reflections/shaders.h"

namespace gloam {
namespace {

constexpr std::uint32_t kImageSide = 256;  // kMostHitDistances texels

template <class T>
Result<std::vector<T>> run_hit_distances(const KernelLab& lab, std::uint32_t unpack, std::vector<float> metres,
                                         std::vector<HitTexel> texels, std::uint32_t result, std::size_t count) {
  metres.resize(kMostHitDistances);
  texels.resize(kMostHitDistances);
  KernelRun kernel(lab, shaders::reflections::hit_distances_comp, {{"kUnpack", unpack}});
  kernel.input(0, metres);
  kernel.output_image(1, gpu::Format::rgba8_unorm, kImageSide, kImageSide);
  kernel.sampled_image(2, gpu::Format::rgba8_unorm, kImageSide, kImageSide, texels);
  kernel.output(3, kMostHitDistances * sizeof(float));
  GLOAM_TRY(kernel.run(kMostHitDistances / 64));
  std::vector<T> all = kernel.template read<T>(result);
  all.resize(count);
  return all;
}

}  // namespace

Result<std::vector<HitTexel>> pack_hit_distances(const KernelLab& lab, std::vector<float> metres) {
  const std::size_t count = metres.size();
  return run_hit_distances<HitTexel>(lab, 0, std::move(metres), {}, 1, count);
}

Result<std::vector<float>> unpack_hit_distances(const KernelLab& lab, std::vector<HitTexel> texels) {
  const std::size_t count = texels.size();
  return run_hit_distances<float>(lab, 1, {}, std::move(texels), 3, count);
}

double held_centimetres(double metres) { return metres > 0.0 ? std::min(100.0 * metres, 65535.0) : 0.0; }

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/reference/kernel_checks.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>

#include "engine/core/text/formatted.h"
#include "modules/reflections/reference/glossy_lines.h"
#include "modules/reflections/reference/hit_distances.h"

namespace gloam {
namespace {

/// Distances at random, then all that mean something special.
std::vector<float> distances_to_pack() {
  std::mt19937 random(18);
  std::uniform_real_distribution<float> any(0.0f, 660.0f);
  std::vector<float> metres(kMostHitDistances - 8);
  for (float& distance : metres) distance = any(random);
  const float infinite = std::numeric_limits<float>::infinity();
  for (const float special : {0.0f, 655.36f, 3e38f, infinite, -1e-6f, -5.0f, -infinite, std::nanf("")})
    metres.push_back(special);
  return metres;
}

Result<KernelError> run_hit_distance_check(KernelLab& lab) {
  KernelError error;
  const std::vector<float> metres = distances_to_pack();
  const auto packed = pack_hit_distances(lab, metres);
  if (!packed) return packed.error();
  for (std::size_t i = 0; i < metres.size(); ++i)
    error.add(std::abs(centimetres_of((*packed)[i]) - held_centimetres(static_cast<double>(metres[i]))),
              formatted("%g m packed", static_cast<double>(metres[i])));
  std::vector<HitTexel> texels;
  for (std::uint32_t i = 0; i < kMostHitDistances; ++i)
    texels.push_back({static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(i >> 8), 7, 9});
  const auto unpacked = unpack_hit_distances(lab, texels);
  if (!unpacked) return unpacked.error();
  for (std::uint32_t i = 0; i < kMostHitDistances; ++i)
    error.add(std::abs(100.0 * static_cast<double>((*unpacked)[i]) - i), formatted("%u cm unpacked", i));
  return error;
}

/// Calls judge(images, columns, words) for images of several sizes.
template <class Judge>
Status each_lines(const Judge& judge) {
  std::mt19937 random(41);
  for (const uvec2 size : {uvec2(4, 3), uvec2(65, 7), uvec2(3, 131), uvec2(97, 33)})
    for (const bool columns : {false, true}) {
      const GlossyImages in = random_glossy_images(random, size.x, size.y);
      GLOAM_TRY(judge(in, columns, formatted("%s of %u x %u texels", columns ? "columns" : "rows", size.x, size.y)));
    }
  return {};
}

Result<KernelError> run_dilation_check(KernelLab& lab) {
  KernelError error;
  const bool direct = lab.device().info().threads_in_turn;
  GLOAM_TRY(each_lines([&](const GlossyImages& in, bool columns, const std::string& words) -> Status {
    const auto found = run_dilation(lab, in, columns, direct);
    if (!found) return found.error();
    double wrong = 0.0;
    for (std::size_t i = 0; i < in.texels(); ++i) {
      const auto twin = dilated_twin(in, static_cast<std::uint32_t>(i % in.c.size.x),
                                     static_cast<std::uint32_t>(i / in.c.size.x), columns, direct);
      wrong += twin && (*found)[i] != *twin ? 1.0 : 0.0;
    }
    error.add(wrong, words);
    return {};
  }));
  return error;
}

Result<KernelError> run_blur_check(KernelLab& lab) {
  KernelError error;
  GLOAM_TRY(each_lines([&](const GlossyImages& in, bool columns, const std::string& words) -> Status {
    const std::vector<std::uint8_t> spread = in.own_spread();
    const auto found = run_glossy_blur(lab, in, spread, columns, lab.device().info().threads_in_turn);
    if (!found) return found.error();
    for (std::size_t i = 0; i < in.texels(); ++i) {
      const auto twin = blurred_twin(in, spread, static_cast<std::uint32_t>(i % in.c.size.x),
                                     static_cast<std::uint32_t>(i / in.c.size.x), columns);
      if (!twin) continue;
      constexpr double kBrightestColor = 4.0;
      const dvec4 apart = max(abs(dvec4(found->core[i]) - twin->core), abs(dvec4(found->tail[i]) - twin->tail));
      error.add(std::max({apart.x, apart.y, apart.z, apart.w}) / kBrightestColor, words);
    }
    return {};
  }));
  return error;
}

constexpr const char* kBlurAdvice = "Set reflections.blur=off, and report the device";

}  // namespace

std::vector<KernelCheck> reflection_kernel_checks() {
  return {{.name = "kernel.dilation",
           .sentence = "widest blur that reaches a texel of reflections against all texels of its line",
           .unit = "texels",
           .bound = 0.0,  // integers; where rounding may decide, nothing is compared
           .advice = kBlurAdvice,
           .quick = true,
           .run = &run_dilation_check},
          {.name = "kernel.glossy_blur",
           .sentence = "blurred lines of reflections against two Gaussians in double precision",
           .unit = "of the brightest",
           // Half floats of 2 to 4 lie 2^-9 apart; devices round to the nearest or towards zero. The device's exp adds
           // to it.
           .bound = 6e-4,
           .advice = kBlurAdvice,
           .quick = true,
           .run = &run_blur_check},
          {.name = "kernel.hit_distances",
           .sentence = "distances of reflections packed into two bytes, and back, against double precision",
           .unit = "cm",
           // Half a step, and the rounding of 65,535 centimetres in a float.
           .bound = 0.505,
           .advice = "Set reflections.blur=off, which reads these distances, and report the device",
           .quick = true,
           .run = &run_hit_distance_check}};
}

}  // namespace gloam

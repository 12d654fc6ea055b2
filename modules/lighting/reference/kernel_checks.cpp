// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/lighting/reference/kernel_checks.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

#include "engine/core/text/formatted.h"
#include "engine/render/kernel_check/kernel_run.h"
#include "modules/lighting/display/tone_reference.h"
#include "shaders/lighting/shaders.h"

namespace gloam {
namespace {

constexpr std::uint32_t kSide = 64;  // of the square of pixels in dither.comp

/// Steps between a rounded value and what double precision rounds it to. Floats of up to 256 steps lie 1.5e-5 apart, so
/// that a value may be rounded to the other side within a few of those; and the kernel adds up to 3e-4 steps, so that a
/// white that is less by rounding stays white.
double steps_apart(float found, float value, uvec2 pixel, std::uint32_t channel) {
  constexpr double kRounding = 4e-5 / 255.0, kAdded = 3e-4 / 255.0;
  const double step = 255.0 * static_cast<double>(found), at = static_cast<double>(value);
  const double least = dithered_step(std::max(at - kRounding, 0.0), pixel, channel);
  const double most = dithered_step(std::min(at + kRounding + kAdded, 1.0), pixel, channel);
  const double outside = std::max({least - step, step - most, 0.0});
  return std::isfinite(step) ? outside : step;
}

Result<KernelError> run_dither(KernelLab& lab) {
  std::vector<float> values;
  for (int i = 0; i <= 96; ++i) values.push_back(static_cast<float>(i / 96.0));
  for (const double step : {0.1, 0.49, 0.51, 1.3, 253.9, 254.4, 254.6, 254.95})
    values.push_back(static_cast<float>(step / 255.0));
  KernelRun kernel(lab, shaders::lighting::dither_comp);
  kernel.input(0, values);
  kernel.output(1, values.size() * kSide * kSide * sizeof(vec3));
  GLOAM_TRY(kernel.run(static_cast<std::uint32_t>(values.size() * kSide * kSide / 64)));
  const std::vector<vec3> found = kernel.read<vec3>(1);
  KernelError error;
  for (std::size_t v = 0; v < values.size(); ++v) {
    double worst = 0.0;
    for (std::uint32_t i = 0; i < kSide * kSide; ++i)
      for (std::uint32_t c = 0; c < 3; ++c) {
        const double apart =
            steps_apart(found[v * kSide * kSide + i][static_cast<int>(c)], values[v], uvec2(i % kSide, i / kSide), c);
        worst = std::isfinite(apart) && apart <= worst ? worst : apart;
      }
    error.add(worst, formatted("a value of %.2f steps", 255.0 * static_cast<double>(values[v])));
  }
  return error;
}

}  // namespace

std::vector<KernelCheck> lighting_kernel_checks() {
  return {{.name = "kernel.dither",
           .sentence = "dithered steps of 8 bits against those in double precision",
           .unit = "of 255",
           // What is left is the rounding of a step over 255.
           .bound = 5e-5,
           .advice = "Set lighting.dither=off, and report the device",
           .quick = true,
           .run = &run_dither}};
}

}  // namespace gloam

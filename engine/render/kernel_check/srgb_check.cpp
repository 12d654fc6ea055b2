// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <cmath>

#include "engine/core/text/formatted.h"
#include "engine/math/srgb.h"
#include "engine/render/kernel_check/engine_checks.h"
#include "engine/render/kernel_check/kernel_run.h"
#include "engine/render/kernel_check/srgb_run.h"
#include "shaders/render/shaders.h"

namespace gloam {
namespace {

Result<KernelError> run_srgb_curves(KernelLab& lab) {
  const std::vector<vec3> values = srgb_values();
  const auto found = run_srgb(lab, values);
  if (!found) return found.error();
  KernelError error;
  for (std::size_t i = 0; i < values.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      const auto value = static_cast<double>(values[i][c]);
      const double encoded = std::abs(static_cast<double>(found->encoded[i][c]) - linear_to_srgb(value));
      const double decoded = std::abs(static_cast<double>(found->decoded[i][c]) - srgb_to_linear(value));
      error.add(encoded, formatted("encoding %g", value));
      error.add(decoded, formatted("decoding %g", value));
    }
  return error;
}

}  // namespace

std::vector<vec3> srgb_values() {
  std::vector<float> channels = {0.0031307f, 0.0031308f, 0.0031309f, 0.04044f, 0.04045f, 0.04046f};
  for (int i = 0; i <= 1020; ++i) channels.push_back(static_cast<float>(i / 1020.0));
  std::vector<vec3> values;
  for (std::size_t i = 0; i < channels.size(); ++i)
    values.emplace_back(channels[i], channels[(i + 1) % channels.size()], channels[channels.size() - 1 - i]);
  return values;
}

Result<SrgbCurves> run_srgb(const KernelLab& lab, const std::vector<vec3>& values) {
  KernelRun kernel(lab, shaders::render::srgb_comp);
  kernel.input(0, values);
  for (const std::uint32_t binding : {1u, 2u, 3u}) kernel.output(binding, values.size() * sizeof(vec3));
  GLOAM_TRY(kernel.run(static_cast<std::uint32_t>((values.size() + 63) / 64)));
  return SrgbCurves{kernel.read<vec3>(1), kernel.read<vec3>(2), kernel.read<vec3>(3)};
}

KernelCheck srgb_check() {
  return {.name = "kernel.srgb",
          .sentence = "encoding and decoding of sRGB against the curves in double precision",
          .unit = "of white",
          // Near white, Vulkan lets log2 err by 2^-21 and exp2 by 3 units in the last place, and the exponent is 2.4.
          .bound = 1.2e-6,
          .advice = "Choose a picture format that the device encodes itself, and report the device",
          .quick = true,
          .run = &run_srgb_curves};
}

}  // namespace gloam

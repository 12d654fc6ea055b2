// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/core/result.h"
#include "engine/math/packing.h"
#include "engine/math/types.h"
#include "engine/render/kernel_check/kernel_lab.h"
#include "modules/depth_of_field/components.h"
#include "modules/depth_of_field/knobs.h"
#include "shaders/depth_of_field/depth_of_field_shared.h"

namespace gloam {

/// A picture with a signed circle of confusion for each pixel, within ±40 pixels.
struct DofInput {
  std::uint32_t width = 1;
  std::uint32_t height = 1;
  std::vector<float> coc;
  std::vector<vec4> light;
  DofKnobs knobs;
  Bokeh bokeh = Bokeh::round;

  DofInput(std::uint32_t w, std::uint32_t h, float everywhere, vec4 shown = vec4(1.0f))
      : width(w), height(h), coc(std::size_t{w} * h, everywhere), light(std::size_t{w} * h, shown) {}
  [[nodiscard]] std::size_t at(std::uint32_t x, std::uint32_t y) const { return std::size_t{y} * width + x; }
};

/// A picture with objects before, in and behind the focus on a ground that recedes.
[[nodiscard]] DofInput objects_in_depth(std::uint32_t width, std::uint32_t height, std::uint32_t seed);

using DofHalf = std::array<std::uint16_t, 4>;

struct DofResult {
  std::vector<DofHalf> halves;
  std::vector<vec4> light;
  std::array<shaders::DofList, GLOAM_DOF_LISTS> lists{};
};

/// The light that the passes read: rounded to half floats.
[[nodiscard]] inline DofHalf dof_half(const vec4& v) {
  return {float_to_half(v.x), float_to_half(v.y), float_to_half(v.z), float_to_half(v.w)};
}
[[nodiscard]] inline vec4 dof_light(const DofHalf& t) {
  return {half_to_float(t[0]), half_to_float(t[1]), half_to_float(t[2]), half_to_float(t[3])};
}

/// Runs the passes of the module on a picture.
[[nodiscard]] Result<DofResult> run_dof(const KernelLab& lab, const DofInput& in);

}  // namespace gloam

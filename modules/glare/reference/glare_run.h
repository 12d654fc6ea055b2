// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "engine/core/result.h"
#include "engine/math/types.h"
#include "engine/render/kernel_check/kernel_lab.h"

namespace gloam {

/// The light of a picture, rows from the top, as half floats hold it.
struct GlareInput {
  uvec2 size{1};
  std::vector<vec4> light;
  std::uint32_t lines = 90;  ///< of kGlareLines, > 0
  float share = 1.0f;        ///< 1: the result is the spread light alone

  explicit GlareInput(uvec2 size_px, float everywhere = 0.0f)
      : size(size_px), light(std::size_t{size_px.x} * size_px.y, vec4(vec3(everywhere), 1.0f)) {}
  [[nodiscard]] vec4& at(std::uint32_t x, std::uint32_t y) { return light[std::size_t{y} * size.x + x]; }
  /// Adds a square lamp of one pixel's size whose centre is at this position, by the area that it covers of each pixel.
  void add_lamp(glm::dvec2 at_px, double brightness);
};

/// Runs the passes of the module. The light that the picture shows.
[[nodiscard]] Result<std::vector<vec4>> run_glare(const KernelLab& lab, const GlareInput& in);

}  // namespace gloam

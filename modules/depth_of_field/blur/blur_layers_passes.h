// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "engine/render/declare/compute_pass.h"
#include "modules/depth_of_field/frame.h"

namespace gloam {

/// A layer of DofLayers.
enum class DofLayer : std::uint8_t { far, near, beyond };

/// A filter of one line through workgroup memory (blur/line.glsl).
struct DofLine {
  std::uint32_t direction = 0;  ///< kernel.glsl: 0 row, 1 column, 2 upwards, 3 rightwards, 4 leftwards
  std::uint32_t list = 0;       ///< list of the far layer; the near layer's is the next
  std::uint32_t other = 0;      ///< line.glsl: share of the second image
};

[[nodiscard]] ComputeProgram dof_prefilter_program(std::uint32_t scale, bool near);
/// Without workgroup memory.
[[nodiscard]] ComputeProgram dof_round_program(std::uint32_t scale, DofLayer layer, bool columns);
[[nodiscard]] ComputeProgram dof_hexagon_lines_program(std::uint32_t scale, DofLayer layer);
[[nodiscard]] ComputeProgram dof_hexagon_rhombi_program(std::uint32_t scale, DofLayer layer);
/// cache: vectors or channels.
[[nodiscard]] ComputeProgram dof_line_program(DofKnobs::Cache cache, std::uint32_t scale, bool near,
                                              const DofLine& line);
/// All programs of the blur with these knobs.
[[nodiscard]] std::vector<ComputeProgram> dof_blur_programs(const DofKnobs& knobs, Bokeh bokeh);

/// Makes the layers from LitOutput.
[[nodiscard]] DofLayers add_dof_prefilter_pass(FrameBuilder& frame, const DofFrame& dof);
/// The layers, blurred.
[[nodiscard]] DofLayers add_dof_blur_passes(FrameBuilder& frame, const DofFrame& dof, const DofLayers& layers);

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>

#include "engine/core/result.h"
#include "engine/render/frame_builder.h"
#include "modules/shadows/maps/mips.h"
#include "modules/shadows/maps/scratch.h"

namespace gloam {

/// The pipeline that draws casters into the scratch image. cut_out: with an alpha test.
[[nodiscard]] gpu::GraphicsPipelineDesc map_pipeline(bool cut_out);

/// The inputs of recorded shadow-map draws.
struct MapRecording {
  const ShadowScratch* scratch = nullptr;
  float bias_units = 0.0f;  ///< ShadowKnobs::bias_units
  gpu::PipelineHandle opaque;
  gpu::PipelineHandle cut_out;  ///< null when no cut-out caster is drawn
};

/// Sets map.opaque, and map.cut_out if a plan draws a cut-out caster. Fails if a pipeline cannot be created.
[[nodiscard]] Status make_map_pipelines(FrameBuilder& frame, std::span<const FacePlan* const> plans, MapRecording& map);

/// Records the draws of one batch of the plan into the scratch image.
void record_draws(FrameBuilder& frame, PassContext& context, const MapRecording& map, const FacePlan& plan,
                  std::size_t batch);

}  // namespace gloam

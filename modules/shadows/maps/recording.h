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

[[nodiscard]] gpu::GraphicsPipelineDesc map_pipeline(bool cut_out);

/// What draws of shadow maps are recorded with.
struct MapRecording {
  const ShadowScratch* scratch = nullptr;
  float bias_units = 0.0f;  ///< ShadowKnobs::bias_units
  gpu::PipelineHandle opaque;
  gpu::PipelineHandle cut_out;  ///< where one is needed
};

/// The pipelines that the plans need.
[[nodiscard]] Status make_map_pipelines(FrameBuilder& frame, std::span<const FacePlan* const> plans, MapRecording& map);

/// Draws a batch of a plan into the scratch map.
void record_draws(FrameBuilder& frame, PassContext& context, const MapRecording& map, const FacePlan& plan,
                  std::size_t batch);

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <initializer_list>

#include "engine/render/frame_builder.h"
#include "modules/shadows/maps/mips.h"
#include "modules/shadows/maps/scratch.h"
#include "modules/shadows/maps/state.h"

namespace gloam {

/// How a caster is drawn into a map.
enum class MapDraw : std::uint8_t {
  whole,
  fronts,   ///< without triangles that face away from the light
  backs,    ///< without triangles that face the light
  cut_out,  ///< with an alpha test
};
/// The pipeline that draws casters into the scratch image.
[[nodiscard]] gpu::GraphicsPipelineDesc map_pipeline(MapDraw draw);

/// Data for recording the maps of a frame. Outlives the declaration, because pass functions run later.
struct MapWork {
  FacePlan backgrounds;
  FacePlan faces;
  const ShadowScratch* scratch = nullptr;
  float bias_units = 0.0f;  ///< ShadowKnobs::bias_units
  gpu::PipelineHandle whole;
  gpu::PipelineHandle fronts;   ///< null when no caster is drawn so
  gpu::PipelineHandle backs;    ///< null when no caster is drawn so
  gpu::PipelineHandle cut_out;  ///< null when no cut-out caster is drawn
  ShadowMipWork mips;
};

/// Sets the other members of `work` from backgrounds and faces. knobs: with the size of the atlas that the faces go
/// to. steepest: see kSteepestSurface. If a pipeline or memory cannot be created, the frame is given up.
void prepare_maps(FrameBuilder& frame, ShadowStates& states, const ShadowKnobs& knobs, float steepest, MapWork& work,
                  MapMips mips = MapMips::all);

/// Prepares the caster sources in these plans (CasterSource::prepare), and sets DrawnRegion::parts.
void prepare_sources(FrameBuilder& frame, std::initializer_list<FacePlan*> plans);

/// Declares what the caster sources in these plans read.
void declare_source_reads(PassBuilder& pass, std::initializer_list<const FacePlan*> plans);

/// Records the draws of one batch into the scratch image. plan: work.backgrounds or work.faces.
void record_draws(FrameBuilder& frame, PassContext& context, const MapWork& work, const FacePlan& plan,
                  std::size_t batch);

}  // namespace gloam

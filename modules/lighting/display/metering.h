// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/frame/frame_graph.h"
#include "engine/frame/transfers/results.h"
#include "engine/render/frame_builder.h"
#include "engine/render/knobs/knob_table.h"
#include "engine/render/module.h"

namespace gloam {

/// The exposure of a view in one frame: `factor`, multiplied by the first float of `buffer` if it is metered.
struct FrameExposure {
  BufferRef buffer;  ///< always there, so that shaders can bind it
  bool metered = false;
  float factor = 1.0f;  ///< for light of LitOutput
};

/// Puts the world's share of lighting.exposure into the world. Before the systems of the world run.
void choose_exposure(World& world, const KnobRegistry& knobs);

/// The exposure of the view, after the pass that meters it, if one is called for. Metering reads LitOutput. An error
/// gives the frame up.
[[nodiscard]] FrameExposure add_exposure_passes(FrameBuilder& frame);

/// Keeps a metered exposure for count_exposure(). For Module::take_result.
void take_metered_exposure(World& world, ViewId view, std::string_view result_name, const FrameResult& result);
/// The counter "lighting.exposure_ev100": the exposure that the scene states, or the last one that was metered for the
/// view's camera and has come back from the GPU.
void count_exposure(const World& world, const RenderView& view, CounterSink& sink);
/// The same, from a frame that has metered.
void count_metered_exposure(std::string_view result_name, const FrameResult& result, CounterSink& sink);

}  // namespace gloam

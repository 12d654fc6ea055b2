// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "engine/render/frame_builder.h"

/// Full-screen passes of the modules' visualizers. A pass draws over the view's picture and writes its plain values to
/// a second image, for tests and tools to read.
namespace gloam {

/// Color targets 0 and 1 of a visualizer's pass.
struct VisualizerTargets {
  ImageRef picture;
  ImageRef values;                               ///< null: only the picture is written
  gpu::LoadOp load_picture = gpu::LoadOp::load;  ///< load: drawn over the picture; clear: in its place
};

/// Declares that a pass writes the view's picture and a new transient image `name` of the view's size.
[[nodiscard]] VisualizerTargets write_visualizer_targets(FrameBuilder& frame, PassBuilder& pass, std::string name,
                                                         std::string module, gpu::Format format);

/// Begins rendering into the targets. The image of values is cleared to 0; viewport and scissor cover the whole view.
void begin_visualizer(PassContext& context, const RenderView& view, const VisualizerTargets& targets);

/// Draws one full-screen triangle into the targets. `bindings`: those of set 0. `constants`: push constants; may be
/// empty.
void record_visualizer(PassContext& context, const RenderView& view, const VisualizerTargets& targets,
                       gpu::PipelineHandle pipeline, std::span<const gpu::Binding> bindings,
                       std::span<const std::byte> constants = {});

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "engine/render/frame_builder.h"
#include "engine/render/scene/draw_pipelines.h"
#include "modules/lighting/environment.h"
#include "modules/lighting/kept_light.h"
#include "modules/shadows/outputs.h"

namespace gloam {

/// Shades the surfaces in the geometry buffer and fills the sky; writes LitOutput.
void add_deferred_pass(FrameBuilder& frame, LightReuse& reuse);
/// Appends the pipelines that add_deferred_pass() wants with these inputs.
void list_deferred_pipelines(const ShadingInputs& inputs, const ShadowsOutputs& shadows, PipelineList& list);

/// Draws blended surfaces over LitOutput, back to front. Does nothing if there are none.
void add_forward_pass(FrameBuilder& frame);
/// Draws BlendedLayer if it is wanted.
void add_blended_layer_passes(FrameBuilder& frame);
/// Draws FrontDepth if it is wanted.
void add_front_depth_passes(FrameBuilder& frame);
/// Lays the depths of blended surfaces over an r32f image, weighted as their light is.
[[nodiscard]] SurfacePass front_depth_surface_pass();
/// Appends the pipelines that add_forward_pass() wants for blended surfaces of these variants.
void list_forward_pipelines(const ShadingInputs& inputs, const ShadowsOutputs& shadows,
                            std::span<const SurfaceVariant> variants, PipelineList& list);

/// Maps LitOutput to TargetOutput. Meters first, in the first frame of a camera without a set exposure.
void add_tone_map_passes(FrameBuilder& frame);

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/render/frame_builder.h"
#include "modules/fog/components.h"

namespace gloam {

/// Pipelines that add_fog_passes uses with these knobs.
void list_fog_pipelines(const KnobRegistry& knobs, PipelineList& list);

/// Blurs LitOutput to a glow and blends the fog over LitOutput.
void add_fog_passes(FrameBuilder& frame, const Fog& fog);

}  // namespace gloam

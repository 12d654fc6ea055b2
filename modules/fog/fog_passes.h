// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/render/frame_builder.h"
#include "modules/fog/components.h"

namespace gloam {

/// What add_fog_passes asks for with the knobs as they are.
void list_fog_pipelines(const KnobRegistry& knobs, PipelineList& list);

/// Blurs LitOutput into a glow and lays the fog over it.
[[nodiscard]] Status add_fog_passes(FrameBuilder& frame, const Fog& fog);

}  // namespace gloam

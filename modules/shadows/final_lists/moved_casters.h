// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/render/frame_builder.h"
#include "modules/shadows/atlas/view_map_state.h"
#include "modules/shadows/final_lists/reuse.h"
#include "modules/shadows/outputs.h"

namespace gloam {

/// Sets what shadows.reuse=reprojected compares: LightInputs::steady and casters of all lights,
/// ListInputs::caster_frame and moved. maps: the state of the view's maps, whose passes are declared.
void set_steady_inputs(const FrameBuilder& frame, const ShadowsOutputs& shadows, const ViewMapState& maps,
                       ListInputs& inputs);

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"
#include "engine/render/frame_builder.h"
#include "modules/shadows/maps/state.h"

namespace gloam {

/// Adds the passes that update the view's shadow maps, and the passes of its final lists if can_generate() and
/// generate_pipelines_ready() are true. Puts ShadowsOutputs on the board. Exposes the image "shadow_atlas", whose
/// texels outside of faces are undefined. Fails if an image, upload or pipeline cannot be created.
[[nodiscard]] Status add_shadow_passes(FrameBuilder& frame, ShadowStates& states);

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"
#include "engine/render/frame_builder.h"
#include "modules/shadows/maps/state.h"

namespace gloam {

/// Brings the view's shadow maps up to date and puts ShadowsOutputs. Exposes "shadow_atlas"; its texels outside of
/// faces hold anything.
[[nodiscard]] Status add_shadow_passes(FrameBuilder& frame, ShadowStates& states);

}  // namespace gloam

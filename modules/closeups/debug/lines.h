// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "engine/render/view.h"
#include "modules/shadows/outputs.h"
#include "shaders/closeups/closeup_views_shared.h"

namespace gloam {

/// The edges of a face's frustum – its near side, its far side, and the four between them; orthographic: of its box –
/// as a view sees them. What lies nearer than the view's near plane, and what lies farther than `rim_pixels` outside
/// its picture, is cut off.
[[nodiscard]] std::vector<shaders::CloseupLine> frustum_lines(const ShadowFace& face, const RenderView& view,
                                                              double rim_pixels);

}  // namespace gloam

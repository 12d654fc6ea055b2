// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "engine/render/view.h"
#include "modules/shadows/outputs.h"
#include "shaders/closeups/closeup_views_shared.h"

namespace gloam {

/// The edges of a face's frustum (orthographic: of its box) as a view sees them: near side, far side, and the four
/// edges between them. Parts nearer than the view's near plane, or more than `rim_pixels` outside its picture, are
/// clipped.
[[nodiscard]] std::vector<shaders::CloseupLine> frustum_lines(const ShadowFace& face, const RenderView& view,
                                                              double rim_pixels);

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "engine/math/types.h"
#include "engine/render/frame_builder.h"
#include "modules/shadows/face_casters.h"
#include "modules/shadows/face_regions.h"
#include "modules/shadows/shadow_cache.h"
#include "modules/shadows/shadow_knobs.h"
#include "modules/shadows/shadow_state.h"
#include "modules/shadows/shadow_views.h"

namespace gloam {

/// A part of a face that is drawn in this frame, to the last bit as if all of the face were.
struct DrawnRegion {
  TexelRect texels;
  std::vector<FaceDraw> draws;
  std::vector<mat4> matrices;  ///< clip from mesh, of `draws`
};

/// One face that is drawn in this frame.
struct DrawnFace {
  ShadowFace face;
  FaceContent content;
  std::vector<DrawnRegion> regions;  ///< they do not overlap
};

/// Sorts the view's faces into those whose maps the atlas holds and those that must be drawn: those with regions, where casters have changed
/// since the last frame, or whole. Counts them, and advances the view's history.
[[nodiscard]] std::vector<DrawnFace> faces_to_draw(FrameBuilder& frame, ViewShadows& kept, const ShadowViews& views,
                                                   const ShadowKnobs& knobs);

}  // namespace gloam

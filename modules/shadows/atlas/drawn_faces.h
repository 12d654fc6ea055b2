// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "engine/math/types.h"
#include "engine/render/frame_builder.h"
#include "modules/shadows/atlas/cache.h"
#include "modules/shadows/atlas/face_casters.h"
#include "modules/shadows/atlas/face_regions.h"
#include "modules/shadows/atlas/view_faces.h"
#include "modules/shadows/atlas/view_maps.h"
#include "modules/shadows/knobs.h"

namespace gloam {

/// A part of a face that is drawn in this frame, to the last bit as if all of the face were.
struct DrawnRegion {
  TexelRect texels;
  std::vector<FaceDraw> draws;
  std::vector<mat4> matrices;  ///< clip from mesh, of `draws`
  /// `draws` are of casters that do not rest; the others' depth is in the image of backgrounds.
  bool on_background = false;
};

/// One face that is drawn in this frame.
struct DrawnFace {
  ShadowFace face;
  FaceContent content;
  std::vector<DrawnRegion> regions;         ///< they do not overlap
  std::vector<FaceBackground> backgrounds;  ///< that the image of backgrounds will hold
};

/// What one frame draws.
struct DrawnMaps {
  std::vector<DrawnFace> faces;
  /// Before them, into the image of backgrounds: what casters that rest make of regions of faces.
  std::vector<DrawnFace> backgrounds;
};

/// Sorts the view's faces into those whose maps the atlas holds and those that must be drawn: those with regions, where
/// casters have changed since the last frame, or whole. Counts them, and advances the view's history: casters that it
/// withholds are not there for faces of their lights.
[[nodiscard]] DrawnMaps faces_to_draw(FrameBuilder& frame, ViewShadows& kept, const ShadowViews& views,
                                      const ShadowKnobs& knobs);

}  // namespace gloam

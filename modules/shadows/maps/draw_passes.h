// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "engine/core/result.h"
#include "engine/render/frame_builder.h"
#include "modules/shadows/atlas/face_regions.h"
#include "modules/shadows/atlas/view_faces.h"
#include "modules/shadows/knobs.h"
#include "modules/shadows/maps/state.h"

namespace gloam {

/// Pipelines of the passes below.
void list_shadow_map_pipelines(const ShadowKnobs& knobs, PipelineList& list);

/// A part of a face in the atlas.
struct FacePart {
  AtlasSquare square;  ///< of the face
  TexelRect texels;    ///< of the face
};

/// The view's atlas and pyramid with this frame's maps. None when no face has a place.
struct ShadowMaps {
  ImageRef atlas;
  ImageRef pyramid;
  std::vector<FacePart> drawn;  ///< in this frame
};

/// Draws the faces whose maps the atlas does not hold, batch by batch through ShadowScratch: passes shadow_map_draw and
/// shadow_map_mips, of which those beyond the last batch do nothing, then coarser mips of all of them: one more
/// shadow_map_mips.
[[nodiscard]] Result<ShadowMaps> add_shadow_map_passes(FrameBuilder& frame, ShadowStates& states, ViewShadows& kept,
                                                       const ShadowViews& views, const ShadowKnobs& knobs);

}  // namespace gloam

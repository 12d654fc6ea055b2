// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "engine/render/frame_builder.h"
#include "modules/shadows/atlas/face_regions.h"
#include "modules/shadows/atlas/view_faces.h"
#include "modules/shadows/knobs.h"
#include "modules/shadows/maps/state.h"

namespace gloam {

/// Appends the pipelines of add_shadow_map_passes().
void list_shadow_map_pipelines(const ShadowKnobs& knobs, PipelineList& list);

/// A rectangle of a face in the atlas.
struct FacePart {
  AtlasSquare square;  ///< place of the face
  TexelRect texels;    ///< the rectangle in the face
};

/// The view's atlas and pyramid with this frame's maps; null refs when no face has a place.
struct ShadowMaps {
  ImageRef atlas;
  ImageRef pyramid;
  std::vector<FacePart> drawn;  ///< parts drawn in this frame; parts of one face follow each other
};

/// Draws the faces whose maps the atlas does not hold, batch by batch through ShadowScratch. Each batch has a pass
/// shadow_map_draw and a pass shadow_map_mips; the number of batches is rounded up to a power of two with empty passes.
/// A last pass shadow_map_mips makes the coarser mips of all faces. On an error the frame is given up.
[[nodiscard]] ShadowMaps add_shadow_map_passes(FrameBuilder& frame, ShadowStates& states, ViewMapState& kept,
                                               const ViewFaces& view_faces, const ShadowKnobs& knobs);

}  // namespace gloam

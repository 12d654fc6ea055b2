// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/render/frame_builder.h"
#include "modules/shadows/maps/draw_passes.h"
#include "modules/shadows/maps/state.h"

namespace gloam {

/// Appends the pipeline of add_shadow_planes_pass().
void list_shadow_plane_pipelines(PipelineList& list);

/// Updates the view's planes (shaders/shadows/maps/planes_shared.h) for the parts of faces that this frame draws: pass
/// shadow_planes. Faces whose planes were not made after their map was drawn are updated as a whole.
/// Returns the image of planes; a null ref if it cannot be created, and the frame is given up.
[[nodiscard]] ImageRef add_shadow_planes_pass(FrameBuilder& frame, ViewMapState& kept, const ShadowMaps& maps,
                                              const ViewFaces& view_faces, const ShadowKnobs& knobs);

}  // namespace gloam

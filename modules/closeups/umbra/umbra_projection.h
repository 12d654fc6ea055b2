// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/math/view_projection.h"
#include "engine/math/world_box.h"
#include "modules/closeups/umbra/light.h"
#include "modules/closeups/umbra/tile_range.h"

namespace gloam {

/// The umbra range: tiles of all pixels for which a subject may hide part of a light. It encloses the volume behind the
/// subject's box as seen from every point of the emitter, including the box, up to the light's range; for a directional
/// light, up to the box around subject and `receivers` (unknown: the subject alone). Empty if the volume is outside the
/// view. The whole view if numbers are not finite or the subject's box is unknown.
///
/// FF XVI §3.4, figure 10: rays through the corners of the bound. Changed: includes the penumbra, clips at the near
/// plane, and the far end encloses the curved end of the range.
[[nodiscard]] TileRange umbra_tiles(const CloseupLight& light, const WorldBox& subject, const WorldBox& receivers,
                                    const ViewProjection& view);

/// The tiles of all pixels that a world-space box may cover. The whole view if the box is unknown or not finite.
[[nodiscard]] TileRange box_tiles(const WorldBox& box, const ViewProjection& view);

}  // namespace gloam

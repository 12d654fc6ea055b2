// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/render/scene/caster_bounds.h"
#include "engine/render/view.h"
#include "modules/closeups/pairs/light.h"
#include "modules/closeups/pairs/views.h"

namespace gloam {

/// Tiles of all pixels of a view that a subject may keep any of a light from: those of the volume behind the subject's
/// box as seen from every point of the emitter, with the box itself, to the light's range; of a directional light in
/// the box round subject and `receivers` (not known: the subject's alone). Empty when none shows. All of the view where
/// numbers are not finite.
///
/// FF XVI §3.4, figure 10: rays through the bound's corners. Changed: penumbra, near plane, ends that hold the curved
/// end of the range.
[[nodiscard]] TileRange umbra_tiles(const CloseupLight& light, const WorldBox& subject, const WorldBox& receivers,
                                    const RenderView& view);

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>

#include "engine/render/view.h"
#include "modules/reflections/frame.h"
#include "modules/reflections/knobs.h"
#include "modules/reflections/planar/patches.h"

namespace gloam {

/// The plane of the patches that the camera sees from above: of all planes of kPlaneThickness the one with the most
/// area, where distant patches count less. None if the camera sees no patch. unit: scene_unit().
[[nodiscard]] std::optional<PlanarMirror> choose_mirror(std::span<const MirrorPatch> patches, const RenderView& view,
                                                        double unit);

/// Chooses the view's plane and adds the companion that draws the scene mirrored at it. Sets or removes the view's
/// PlanarMirror.
void add_mirrored_view(World& world, const ViewSettings& main, const ReflectionKnobs& knobs,
                       CompanionViews& companions);

/// Settings of the view of `main` mirrored at the plane, of the size of the reflection images. unit: scene_unit().
[[nodiscard]] ViewSettings mirrored_settings(const ViewSettings& main, const PlanarMirror& mirror, std::uint32_t scale,
                                             double unit);

}  // namespace gloam

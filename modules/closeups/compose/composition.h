// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "engine/render/frame_builder.h"
#include "modules/closeups/knobs.h"
#include "modules/closeups/pairs/views.h"
#include "modules/lights/outputs.h"
#include "modules/shadows/outputs.h"
#include "shaders/closeups/closeups_shared.h"

namespace gloam {

/// The constants of a pair whose face has its place in a map. suns: of the view. The members pair and first_item are
/// not set.
[[nodiscard]] shaders::CloseupConstants constants_of(const CloseupView& pair, const RenderView& view,
                                                     std::span<const DirectionalLook> suns);

/// What the pairs change visibilities by.
[[nodiscard]] ComposedLights composed_lights(std::span<const CloseupView> pairs, const CloseupKnobs& knobs);

/// Lowers the visibilities in the final lists on the board by what close-up maps say: passes closeup_tiles and
/// closeup_compose. constants: of each pair. shadows: with the filter for close-up maps, and with atlas, pyramid and
/// block of the map that holds the pairs' faces.
void add_composition(FrameBuilder& frame, std::span<const CloseupView> pairs,
                     std::span<const shaders::CloseupConstants> constants, const ShadowsOutputs& shadows);

/// Appends the pipelines of these passes.
void list_composition_pipelines(const ShadowsOutputs& shadows, const gpu::DeviceInfo& device, PipelineList& list);

}  // namespace gloam

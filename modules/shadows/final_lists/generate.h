// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "engine/render/frame_builder.h"
#include "modules/lights/outputs.h"
#include "modules/shadows/atlas/view_map_state.h"
#include "modules/shadows/final_lists/reuse.h"
#include "modules/shadows/knobs.h"
#include "modules/shadows/outputs.h"

namespace gloam {

/// Whether the view can have final lists: shadows.mode=deferred, visibilities are quantised, and local lights (if any)
/// have early lists.
[[nodiscard]] bool can_generate(const FrameBuilder& frame, const ShadowKnobs& knobs);

/// Appends the pipelines of add_generate_passes().
void list_generate_pipelines(const ShadowKnobs& knobs, const ShadowsOutputs& shadows, const LightsOutputs& lights,
                             const gpu::DeviceInfo& device, PipelineList& list);
/// Whether the pipelines of add_generate_passes() are ready. If not, they are made in the background, and the frame
/// must do without final lists. Always true when the services wait for pipelines.
[[nodiscard]] bool generate_pipelines_ready(const FrameBuilder& frame, const ShadowKnobs& knobs,
                                            const ShadowsOutputs& shadows);

/// Makes final lists from early lists: passes shadow_list_start, list_tile_lights, classify_shadows, generate_shadows,
/// finish_lists. Puts a FinalListNote on the board. planes: from add_shadow_planes_pass(), or null when tiles are not
/// classified. maps: the state of the view's maps, whose passes are declared. shadows: without final_lists. reuse: of
/// the view. None if the frame was given up.
[[nodiscard]] std::optional<FinalLists> add_generate_passes(FrameBuilder& frame, const ShadowKnobs& knobs,
                                                            ImageRef planes, const ViewMapState& maps,
                                                            const ShadowsOutputs& shadows, ViewReuse& reuse);

}  // namespace gloam

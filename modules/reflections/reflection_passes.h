// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "engine/frame/transfers/staging.h"
#include "engine/render/frame_builder.h"
#include "modules/reflections/frame.h"

namespace gloam {

/// PassPhase::announce: puts ReflectionPlan on the board and takes over the specular ambient term, if a visible
/// material reflects.
void announce_reflections(FrameBuilder& frame);

/// PassPhase::shading, after lighting: adds the reflections to LitOutput and puts ReflectionHandles on the board.
void add_reflection_passes(FrameBuilder& frame, Staging& staging);

/// Pipelines that add_reflection_passes() uses with these knobs in a world with proxies. direct: on a device that runs
/// threads in turn. blended: views have a BlendedLayer. probes: number of captured probes.
void list_reflection_pipelines(const ReflectionKnobs& knobs, bool direct, bool blended, std::size_t probes,
                               PipelineList& list);

}  // namespace gloam

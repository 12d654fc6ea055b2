// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "engine/frame/transfers/staging.h"
#include "engine/render/frame_builder.h"
#include "modules/reflections/frame.h"
#include "modules/reflections/recapture/recapture.h"
#include "modules/reflections/relighting/capture_factors.h"

namespace gloam {

/// PassPhase::announce: puts ReflectionPlan and SurroundingProbes on the board, if a visible material reflects.
/// factors: of the frame's world; brought up to date if captures are shown. progress: of the frame's world.
void announce_reflections(FrameBuilder& frame, Staging& staging, CaptureFactors& factors, ProbeProgress& progress);

/// PassPhase::lists: finds the surfaces that reflect, and what they mirror of their surroundings.
void add_reflection_list_passes(FrameBuilder& frame);

/// PassPhase::shading, after lighting: adds mirrored images to LitOutput and puts ReflectionHandles on the board.
/// factors: as of announce_reflections(); notes captures that the frame makes again.
void add_reflection_passes(FrameBuilder& frame, Staging& staging, CaptureFactors& factors);

/// Pipelines that add_reflection_passes() uses with these knobs in a world with proxies. direct: on a device that runs
/// threads in turn. blended: views have a BlendedLayer. probes: number of captured probes.
void list_reflection_pipelines(const ReflectionKnobs& knobs, bool direct, bool blended, std::size_t probes,
                               PipelineList& list);

}  // namespace gloam

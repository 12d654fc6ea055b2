// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/render/frame_builder.h"
#include "engine/render/pipelines/pipelines.h"
#include "modules/particles/frame.h"
#include "modules/particles/lighting/light_sprites_pass.h"

namespace gloam {

/// PassPhase::translucent: simulates, sorts, lights and draws the particles of the emitters in view, and puts a
/// ParticlesFrame on the board. No passes if there are no such emitters.
void add_particle_passes(FrameBuilder& frame);

/// Pipelines of all passes of a view without a clip plane. version, jittered: of the last frame, or default ones.
void list_particle_pipelines(ParticleLighting lighting, const ParticleLightVersion& version, bool jittered,
                             bool threads_in_turn, PipelineList& list);

}  // namespace gloam

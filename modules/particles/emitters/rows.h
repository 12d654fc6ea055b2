// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <unordered_map>
#include <vector>

#include "engine/ecs/entity.h"
#include "engine/render/view.h"
#include "modules/particles/emitters/placed.h"
#include "modules/particles/emitters/strongest_lights.h"
#include "modules/particles/emitters/visible.h"
#include "shaders/particles/particles_shared.h"

namespace gloam {

/// Indices in the view's LightBlock, with GLOAM_PARTICLE_DIRECTIONAL for directional lights.
using LightIndices = std::unordered_map<Entity, std::uint32_t>;

/// The row of an emitter, without its sort keys and its map. first: place of its oldest particle. Lights that the view
/// does not have are left out.
[[nodiscard]] shaders::ParticleEmitterRow emitter_row(const PlacedEmitter& emitter, const VisibleEmitter& visible,
                                                      const LightsOfEmitter& lights, const LightIndices& indices,
                                                      const RenderView& view, std::int64_t step, std::uint32_t first);

/// Adds the emitter's path to the poses of a view, and its place there to the row. It has none if it rests.
void add_path(const PlacedEmitter& emitter, const RenderView& view, std::int64_t step, shaders::ParticleEmitterRow& row,
              std::vector<shaders::ParticlePose>& poses);

}  // namespace gloam

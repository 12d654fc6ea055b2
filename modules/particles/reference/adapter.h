// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "engine/core/result.h"
#include "engine/render/reference/reference.h"
#include "modules/particles/baked_light.h"

namespace gloam {

/// Maps of the emitters that the input's frame shows, with the light of all lights and the triangles of that moment:
/// from the input's store, or traced with input.samples rays for each texel and light and then stored. per_pixel is
/// set. Usage error when the input has no tracer.
[[nodiscard]] Result<ParticleLightMaps> find_particle_light(const ReferenceInput& input);

/// The frame with its particles lit at each pixel by find_particle_light(). Afterwards the world has its own maps
/// again, with a raised version. Usage error when the frame cannot be drawn again.
[[nodiscard]] Result<FramePictures> draw_traced_particles(const ReferenceInput& input);

/// The references of the module's knobs.
[[nodiscard]] std::vector<ReferenceInfo> particle_references();

}  // namespace gloam

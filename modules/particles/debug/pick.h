// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "engine/render/module.h"
#include "engine/render/readback/capture.h"
#include "modules/particles/frame.h"

namespace gloam {

/// Copies of the particles and of their order.
[[nodiscard]] Status add_particle_pick_copies(FrameBuilder& frame, const ParticlesFrame& particles, Captures& copies);

/// Counts the sprites that cover the pixel before its surface, by emitter; nothing if there are none.
[[nodiscard]] std::vector<std::string> particle_pick_lines(const FrameBuilder& frame, const PickedPixel& pixel,
                                                           const Captures& copies);

}  // namespace gloam

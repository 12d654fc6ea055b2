// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "engine/render/module.h"
#include "modules/particles/frame.h"

namespace gloam {

[[nodiscard]] std::vector<VisualizerInfo> particle_visualizers();

/// Shows the number of sprites at each pixel, if the view shows overdraw. particles: null if there are none.
void add_overdraw_passes(FrameBuilder& frame, const ParticlesFrame* particles);

}  // namespace gloam

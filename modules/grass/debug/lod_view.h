// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "engine/render/module.h"
#include "modules/grass/frame.h"

namespace gloam {

[[nodiscard]] std::vector<VisualizerInfo> grass_visualizers();

/// Draws the blades again over the picture, coloured by draw class, if the view shows grass_lod.
void add_grass_view_pass(FrameBuilder& frame, const GrassFrame& grass);

}  // namespace gloam

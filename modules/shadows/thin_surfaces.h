// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

namespace gloam {

/// On the board if the frame draws thin surfaces into the geometry buffer (encode_thin_color() in gbuffer_api.glsl). A
/// module that draws them puts it there in PassPhase::announce. Without it no shader looks for them.
struct ThinSurfaces {};

}  // namespace gloam

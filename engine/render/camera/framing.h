// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "engine/ecs/world.h"
#include "engine/render/view.h"

namespace gloam {

/// A camera for a world that has none: it looks at everything drawn, in its pose, from three quarters of the front (+Z)
/// and a little above, and shows all of it in nine tenths of the picture's width or height. Morph targets are not
/// counted. A world without meshes is seen from near its origin. Size in pixels. Call it after the scene systems have
/// run; it reads all positions of all instances.
[[nodiscard]] ViewSettings framed_view(const World& world, std::uint32_t width, std::uint32_t height);

}  // namespace gloam

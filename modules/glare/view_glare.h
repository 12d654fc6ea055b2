// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/ecs/world.h"
#include "engine/render/view.h"

namespace gloam {

/// The share that counts: 0…kMostGlare. A share that is not a number counts as none.
[[nodiscard]] float counted_glare(float share);

/// The share of light that the lens of the view's camera scatters (Glare, DefaultGlare).
[[nodiscard]] float glare_share(const World& world, const RenderView& view);

}  // namespace gloam

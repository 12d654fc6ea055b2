// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/ecs/world.h"

namespace gloam {

/// The share of light that a camera's lens scatters by default.
inline constexpr float kUsualGlare = 0.02f;
/// The most that counts: a greater share has the effect of this one.
inline constexpr float kMostGlare = 0.2f;

/// Component of a camera: the share of the picture's light that its lens scatters, 0…kMostGlare. 0: none.
struct Glare {
  float share = kUsualGlare;
};

/// World resource: the glare of views whose camera has no Glare. A world without it has none there. Scenes from files
/// and the built-in ones have it.
struct DefaultGlare {
  float share = kUsualGlare;
};

/// Gives the world the usual DefaultGlare if it has none.
void add_default_glare(World& world);

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "engine/render/view.h"

namespace gloam {

/// First view of a bake; its views have this id and the following ones.
inline constexpr ViewId kFirstBakeView{0xba4e0000};
/// Views that draw_cube_faces() draws at once; the most of any frame of a bake.
inline constexpr std::uint32_t kBakeViews = 6;

/// Settings that all views of a bake share: the static scene, without the effects that reflections add themselves or
/// that belong to one camera. The caller adds size, pose and lens.
[[nodiscard]] ViewSettings capture_view(std::uint32_t index);
/// Leaves out all lights: what remains is emission, the sky, and what the sky lights.
void leave_lights_out(ViewSettings& settings);

}  // namespace gloam

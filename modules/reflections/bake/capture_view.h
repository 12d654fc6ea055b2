// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "engine/render/view.h"

namespace gloam {

/// First view of a bake; its views have this id and the following ones.
inline constexpr ViewId kFirstBakeView{0xba4e0000};
/// Views of a bake: those of six faces, with lights and without.
inline constexpr std::uint32_t kBakeViews = 12;

/// Settings that all views of a bake share: the static scene, without the effects that reflections add themselves or
/// that belong to one camera. Captured probes
/// of the world are shown. The caller adds size, pose and lens.
[[nodiscard]] ViewSettings capture_view(std::uint32_t index);
/// Leaves out all lights: what remains is emission, the sky, and what the sky lights. Gives the view another id.
void leave_lights_out(ViewSettings& settings);
/// Whether this is a view of a bake without lights. In captured probes it shows their light without lamps.
[[nodiscard]] bool is_unlit_capture(ViewId view);

}  // namespace gloam

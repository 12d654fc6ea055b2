// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string_view>

#include "engine/render/frame_builder.h"
#include "shaders/shadows/maps/map_shared.h"

namespace gloam {

/// The light of a view "NAME:LIGHT" among those of the frame's view; nothing when it reaches nothing there.
[[nodiscard]] std::optional<shaders::ShownLightConstants> shown_light(const FrameBuilder& frame, std::string_view name);

}  // namespace gloam

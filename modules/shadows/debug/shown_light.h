// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string_view>

#include "engine/core/once_log.h"
#include "engine/render/frame_builder.h"
#include "shaders/shadows/maps/map_shared.h"

namespace gloam {

/// The index of the light with this name among the lights of the frame's view; none when it does not exist or reaches
/// nothing in view.
[[nodiscard]] std::optional<shaders::ShownLightConstants> shown_light(const FrameBuilder& frame, std::string_view name);

/// The same for the light that FrameBuilder::visualizer() names after ':'. Logs one warning when there is none.
[[nodiscard]] std::optional<shaders::ShownLightConstants> shown_light_or_warn(const FrameBuilder& frame,
                                                                              OnceLog& once_log);

}  // namespace gloam

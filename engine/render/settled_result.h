// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "engine/render/frame_builder.h"

namespace gloam {

/// The newest settled result (FrameResults::settled) that FrameBuilder::keep_result has kept under this module and name
/// for the frame's world and view; null if there is none.
[[nodiscard]] const FrameResult* settled_result(const FrameBuilder& frame, std::string_view module,
                                                std::string_view name);

}  // namespace gloam

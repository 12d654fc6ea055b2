// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "modules/accuracy/module.h"

namespace gloam {

/// Draws the frames up to frame 0, so that data carried from frame to frame has settled, and frame 0 until its picture
/// is complete.
[[nodiscard]] Status settle(CostSubject& subject);
/// The same, and reads frame 0.
[[nodiscard]] Result<FramePictures> draw_settled(CostSubject& subject);

}  // namespace gloam

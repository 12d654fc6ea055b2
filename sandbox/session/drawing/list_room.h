// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string_view>

#include "engine/core/result.h"
#include "engine/render/renderer.h"
#include "sandbox/output/frame_sample.h"

namespace gloam {

/// Whether the visualizer shows lists (VisualizerInfo::shows_lists). name: NAME or NAME:ARGUMENT.
[[nodiscard]] bool shows_lists(const Renderer& renderer, std::string_view name);

/// Draws the frame again until no tile of its light lists or final lists lacks room, or until further frames do not
/// help: buffers grow from the counters of earlier frames. last: the sample of the last frame, before and after.
[[nodiscard]] Status draw_until_lists_fit(const std::function<Result<FrameSample>()>& draw, FrameSample& last);

}  // namespace gloam

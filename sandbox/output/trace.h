// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>

#include "sandbox/output/frame_sample.h"

namespace gloam {

/// A trace for chrome://tracing and Perfetto: one row per CPU thread with its zones, and one row "GPU" with the passes.
/// The CPU and GPU clocks share no origin, so the passes of a frame are placed one after another from the frame's
/// begin, each with its measured duration.
[[nodiscard]] std::string chrome_trace(std::span<const FrameSample> samples);

}  // namespace gloam

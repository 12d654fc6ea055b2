// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>

#include "sandbox/output/frame_sample.h"

namespace gloam {

/// A trace for chrome://tracing and Perfetto: one row a CPU thread with its zones, one row "GPU" with the passes. The
/// clocks of CPU and GPU share no origin: the passes of a frame stand one after another from the frame's begin, each as
/// long as it took.
[[nodiscard]] std::string chrome_trace(std::span<const FrameSample> samples);

}  // namespace gloam

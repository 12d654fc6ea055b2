// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>

#include "sandbox/output/frame_sample.h"

namespace gloam {

/// A trace for chrome://tracing and Perfetto: one row per CPU thread with its zones, one row "GPU" with the passes, and
/// the span of each frame. Passes have their measured begins and ends; the gaps between them are barriers and waits of
/// the GPU. Its clock is placed on the CPU's by one offset for all samples, so that no frame begins before its
/// submission: the row is early by at most the shortest delay between a submission and its begin. Untimed passes are
/// left out.
[[nodiscard]] std::string chrome_trace(std::span<const FrameSample> samples);

}  // namespace gloam

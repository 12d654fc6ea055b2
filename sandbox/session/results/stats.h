// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>

#include "engine/gpu/types.h"
#include "engine/render/governor/frame_budget.h"
#include "engine/render/knobs/knobs.h"
#include "sandbox/output/frame_sample.h"
#include "sandbox/output/json_text.h"

namespace gloam {

/// Scene, device and picture size (in pixels) of a run, for the head of its stats.
struct RunDescription {
  std::string scene;
  gpu::DeviceInfo device;
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::uint32_t in_flight = 1;  ///< frames that were unfinished at a time
  std::vector<BudgetState> budgets = {};
};

/// The JSON text of `--stats` (schema version 1). samples: all frames of the run, in order, at least one. If there are
/// several, the times leave out the first. "in_flight" is absent if it is 1, "budget" without a budget, and
/// "effect_budgets" without one for an effect; "budget" is that of frames, or else of the first effect. Times of a
/// system or pass are over the frames in which it ran; several calls of one name in a frame are added up. Counters and
/// memory are those of the last frame, together with `extra_counters`. Figures that are not measured (bytes on the CPU)
/// are absent.
[[nodiscard]] std::string stats_json(const RunDescription& run, std::span<const FrameSample> samples,
                                     const std::map<std::string, double>& extra_counters, const KnobRegistry& knobs);

/// Returns {"name", "driver", "type", "subgroup_size"} of the device. The type is "none" if the run used no device.
[[nodiscard]] Json device_json(const gpu::DeviceInfo& device);

/// The number of pixels with a component that is not a number. rgba: four floats per pixel.
[[nodiscard]] std::uint64_t count_nan_pixels(std::span<const float> rgba);

}  // namespace gloam

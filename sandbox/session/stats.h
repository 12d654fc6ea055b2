// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>

#include "engine/gpu/types.h"
#include "engine/render/knobs/knobs.h"
#include "sandbox/output/frame_sample.h"
#include "sandbox/output/json_writer.h"

namespace gloam {

/// What a run was, for the head of its stats.
struct RunDescription {
  std::string scene;
  gpu::DeviceInfo device;
  std::uint32_t width = 0;
  std::uint32_t height = 0;
};

/// The `--stats` text (schema version 1). samples: every frame of the run, in order, at least one. Of several frames
/// the first is left out of the times. A system or pass that did not run in every frame is judged by the frames in
/// which it ran; several calls of one name in a frame add up. Counters and memory are of the last frame;
/// `extra_counters` join them.
[[nodiscard]] std::string stats_json(const RunDescription& run, std::span<const FrameSample> samples,
                                     const std::map<std::string, double>& extra_counters, const KnobRegistry& knobs);

/// {"name", "driver", "type", "subgroup_size"}; a run that used no device has type "none".
void write_device(JsonWriter& json, const gpu::DeviceInfo& device);

/// The number of pixels with a component that is not a number. rgba: four floats a pixel.
[[nodiscard]] std::uint64_t count_nan_pixels(std::span<const float> rgba);

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "engine/gpu/vulkan/startup/context.h"

namespace gloam::gpu::vulkan {

/// Ifs with an else (spirv::count_selections) of a shader that each compiler can take as it is. SwiftShader needs 5 ms
/// more for 16 of them in one loop, 100 ms for 20, and no end is seen for the 100 of shadow filters.
inline constexpr std::uint64_t kMostSelections = 16;

/// Whether the device's compiler walks all paths through a loop, so that its time doubles with each if that has an else
/// (spirv::split_selections avoids that). Measured once per process and driver, by compiling a small shader in both
/// forms.
[[nodiscard]] bool walks_all_paths(Context& context);

}  // namespace gloam::gpu::vulkan

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/gpu/types.h"

namespace gloam::gpu::spirv {

/// The module with these values in place of its specialisation constants (those that are not named keep their
/// defaults) and without the code that they disable: blocks that branches on constants never reach, and functions that
/// nothing calls then. A driver gives the same result with VkSpecializationInfo, but translates disabled code before it
/// drops it, and Mesa 22.3 evaluates choices between constant vectors wrongly.
/// words: a valid module. Empty if the module has no specialisation constants, or control flow that is not handled
/// (OpSwitch, a loop whose back edge is disabled while its continue target is not): use the module as it is then.
[[nodiscard]] std::vector<std::uint32_t> specialize(std::span<const std::uint32_t> words,
                                                    std::span<const NumberedConstant> constants);

}  // namespace gloam::gpu::spirv

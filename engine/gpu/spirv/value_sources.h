// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/gpu/spirv/control_flow.h"

namespace gloam::gpu::spirv {

/// What a value can depend on. A value that depends on several sources has the last of them.
enum class ValueSource : std::uint8_t {
  constant,  ///< constants alone
  uniform,   ///< uniform blocks and push constants too, read at constant offsets
  runtime,   ///< inputs, textures, buffers, workgroup memory, other invocations
};

/// The source of each id of a module, by id. Follows values through function calls, loops and local variables. A value
/// that branches choose among constants counts as `uniform`, because a uniform may decide the branch; the counter of a
/// loop keeps the source of its start and step.
/// instructions: of a valid module. bound: ids are below it.
[[nodiscard]] std::vector<ValueSource> value_sources(std::span<const Instruction> instructions, std::uint32_t bound);

}  // namespace gloam::gpu::spirv

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "engine/gpu/spirv/reflection.h"

namespace gloam::gpu {

/// Whether passes that were written for one shader can use another in its place: the same stage, workgroup size, push
/// constants, bindings, layouts of structures, and types of specialisation constants that both have. Returns the first
/// difference as a clause ("binding 'lights' is gone"); empty: none.
[[nodiscard]] std::string interface_difference(const SpirvReflection& from, const SpirvReflection& to);

}  // namespace gloam::gpu

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "engine/render/kernel_check/kernel_check.h"

namespace gloam {

/// The checks of the engine's kernels and of those of every module of this build.
[[nodiscard]] std::vector<KernelCheck> all_kernel_checks();

}  // namespace gloam

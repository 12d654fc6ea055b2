// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "engine/render/kernel_check/kernel_check.h"

namespace gloam {

/// The checks of the module's kernels, against the convolution of the whole picture.
[[nodiscard]] std::vector<KernelCheck> glare_kernel_checks();

}  // namespace gloam

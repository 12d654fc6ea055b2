// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "engine/render/kernel_check/kernel_check.h"

namespace gloam {

[[nodiscard]] std::vector<KernelCheck> reflection_kernel_checks();

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/render/kernel_check/kernel_check.h"

// The parts of engine_kernel_checks().

namespace gloam {

[[nodiscard]] KernelCheck sort_check();
/// Positions, and directions of normals and tangents.
[[nodiscard]] std::vector<KernelCheck> deform_checks();
[[nodiscard]] KernelCheck srgb_check();

}  // namespace gloam

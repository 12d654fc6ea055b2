// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "engine/core/result.h"
#include "engine/math/types.h"
#include "engine/render/kernel_check/kernel_lab.h"

namespace gloam {

/// The curves of shaders/common/math.glsl at some values.
struct SrgbCurves {
  std::vector<vec3> encoded;
  std::vector<vec3> decoded;
  std::vector<vec3> slopes;  ///< of decoding
};
[[nodiscard]] Result<SrgbCurves> run_srgb(const KernelLab& lab, const std::vector<vec3>& values);

/// Three channels of 0 … 1 in steps of 1/1020, which include all codes of 8 bits, and the ends of the linear parts.
[[nodiscard]] std::vector<vec3> srgb_values();

}  // namespace gloam

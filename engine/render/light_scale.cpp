// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/light_scale.h"

#include <algorithm>
#include <cmath>

namespace gloam {

float light_scale(const SceneEnvironment& environment) {
  if (!environment.has_exposure || !std::isfinite(environment.exposure_ev100)) return 1.0f;
  constexpr int kFirst = -2, kLast = 7;  // floor(log2(white)) that needs no scale
  const int white = static_cast<int>(std::floor(environment.exposure_ev100 + std::log2(1.2f)));
  return std::ldexp(1.0f, std::clamp(std::clamp(white, kFirst, kLast) - white, -100, 100));
}

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/lighting/display/exposure.h"

#include <cmath>

namespace gloam {

float exposure_from_ev100(float ev100) { return 1.0f / (1.2f * std::exp2(ev100)); }

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "engine/render/knobs/measure.h"

namespace gloam {

/// What tells the values of shadows.classify apart: the share of pairs of a tile and a light whose pixels have to be
/// asked.
[[nodiscard]] std::vector<MeasureInfo> shadow_measures();

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "engine/render/knobs/measure.h"

namespace gloam {

/// The measure of shadows.classify: the share of tile lights whose pixels are filtered.
[[nodiscard]] std::vector<MeasureInfo> shadow_measures();

}  // namespace gloam

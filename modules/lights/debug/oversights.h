// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "engine/render/module.h"

namespace gloam {

/// Lights that light nothing by mistake: without a WorldTransform, or with properties that are not finite.
[[nodiscard]] std::vector<Oversight> dark_lights(const World& world);

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "engine/scene/assets.h"

namespace gloam {

/// The first thing in these assets that cannot be drawn, in one sentence that names it: streams of the wrong length,
/// missing normals or bounds, indices, materials, textures or images out of range, values that are not finite. Empty if
/// there is none. The renderer asserts that it is empty when it uploads assets; scene files never get that far.
[[nodiscard]] std::string asset_fault(const SceneAssets& assets);

}  // namespace gloam

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
/// The same for one asset and what it refers to. index: less than assets.count(kind).
[[nodiscard]] std::string asset_fault(const SceneAssets& assets, AssetKind kind, std::uint32_t index);
/// The same for the assets that changed after this SceneAssets::revision(), and for those that refer to one that was
/// destroyed after it.
[[nodiscard]] std::string asset_fault_since(const SceneAssets& assets, std::uint64_t revision);

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string_view>

#include "engine/ecs/world.h"

namespace gloam {

/// Worlds of fewer triangles are drawn without levels of detail: they would save little, and have no levels in memory.
inline constexpr std::uint64_t kFewestTrianglesForLevels = 131072;

/// Why a knob of levels changes nothing in such a world.
inline constexpr std::string_view kNoLevels = "the scene has fewer than 131,072 triangles";

/// Triangles of all mesh instances of the world.
[[nodiscard]] std::uint64_t instance_triangles(const World& world);
[[nodiscard]] inline bool may_have_levels(const World& world) {
  return instance_triangles(world) >= kFewestTrianglesForLevels;
}

}  // namespace gloam

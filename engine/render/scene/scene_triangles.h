// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "engine/ecs/world.h"
#include "engine/render/scene/gpu_scene.h"

namespace gloam {

/// Worlds of fewer triangles are drawn without levels of detail: they would save little, and have no levels in memory.
inline constexpr std::uint64_t kFewestTrianglesForLevels = 131072;

/// Triangles of all mesh instances of the world.
[[nodiscard]] std::uint64_t instance_triangles(const World& world, const GpuScene& scene);

}  // namespace gloam

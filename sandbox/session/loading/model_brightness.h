// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "engine/ecs/world.h"

namespace gloam {

/// Mean share of light that the drawn surfaces reflect, 0…1, by the area of their triangles at rest. Counts base
/// colours, their textures and vertex colours, and what surfaces mirror; shadows, views and alpha are not considered.
/// Surfaces that emit count only by what they reflect; black ones that emit (KHR_materials_unlit) do not count at all.
/// nullopt: nothing counts.
[[nodiscard]] std::optional<double> mean_reflectance(const World& world);

}  // namespace gloam

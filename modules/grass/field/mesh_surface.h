// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/math/types.h"
#include "engine/scene/assets.h"
#include "modules/grass/growth/surface.h"

namespace gloam {

/// All primitives of the mesh in the rest pose: skins and morph targets have no effect. The triangles do not depend on
/// the matrix's translation, only the origin does.
[[nodiscard]] GrowthSurface growth_surface(const Mesh& mesh, const dmat4& world_from_mesh);

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/draws/casters.h"

#include "engine/render/draws/draw_lists.h"

namespace gloam {

shaders::DrawConstants caster_constants(const Caster& caster, const dvec3& origin) {
  return draw_constants(caster.world_from_mesh, origin);
}

}  // namespace gloam

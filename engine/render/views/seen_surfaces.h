// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/ecs/world.h"
#include "engine/render/view.h"

namespace gloam {

/// Whether a view may see anything but the sky; a view resource, set after the view's draw lists are made and before
/// modules are asked whether the view demands them. False if no mesh is in the view's frustum, the host draws no
/// geometry, and no module that takes part draws anything (Module::shows_surfaces).
struct SeenSurfaces {
  bool any = true;
};

/// True until it is known.
[[nodiscard]] inline bool sees_surfaces(const World& world, const RenderView& view) {
  const auto* seen = world.try_view_resource<SeenSurfaces>(view.id);
  return seen == nullptr || seen->any;
}

}  // namespace gloam

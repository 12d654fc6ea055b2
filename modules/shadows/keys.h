// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/ecs/world.h"
#include "engine/render/module.h"
#include "engine/scene/key_registry.h"

namespace gloam {

/// Registers the gloam.light.* keys that shape shadows, and what reads cookies when a scene is loaded.
void add_shadow_keys(KeyRegistry& registry);

/// Whether a light of the world, or with a view one that is in it, casts shadows or projects an image.
[[nodiscard]] Demand shadow_demand(const World& world, const RenderView* view);

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/ecs/world.h"
#include "engine/render/module.h"
#include "engine/scene/keys/registry.h"

namespace gloam {

/// Registers the gloam.light.* keys of shadows, and load_cookies() to run when a scene has been loaded.
void add_shadow_keys(KeyRegistry& registry);

/// Whether a light of the world (view: null) or of the view casts shadows or projects a cookie, with the reason.
[[nodiscard]] Demand shadow_demand(const World& world, const RenderView* view);

}  // namespace gloam

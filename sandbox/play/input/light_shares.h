// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <unordered_map>

#include "engine/core/result.h"
#include "engine/ecs/entity.h"
#include "engine/render/view.h"
#include "sandbox/session/session.h"

namespace gloam {

/// Each light's share of the diffuse light of the view's last frame before shadows, 0…1, at a grid of pixels; lights
/// that reach none of them are left out. Draws that frame again and waits for the GPU.
[[nodiscard]] Result<std::unordered_map<Entity, double>> light_shares(Session& session, ViewId view);

}  // namespace gloam

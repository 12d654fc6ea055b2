// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "engine/ecs/world.h"

namespace gloam {

/// Sentences about the proxies and probes that no surface of the world can show, one for each reason, and about rooms
/// that have no box. For a world whose transforms are up to date.
///
/// A proxy or a probe is named only if it certainly cannot be seen in a reflection, from any camera: by the bounds of
/// reflective surfaces, and by the rules that culling and shaders follow. What a playing clip moves, and surfaces that
/// are skinned or morphed, may be anywhere. Proxies that flames have brought (FlameProxy) are not named.
[[nodiscard]] std::vector<std::string> unseen_captures(const World& world);

}  // namespace gloam

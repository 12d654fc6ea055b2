// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>
#include <vector>

#include "engine/core/result.h"
#include "engine/scene/gltf/document.h"

namespace gloam::gltf {

/// Imports the skins of a checked document.
[[nodiscard]] Result<std::vector<Skin>> import_skins(const Document& document);

/// Imports all clips, in file order. If several clips animate the same property of a node, only one keeps its channel:
/// the one named `preferred`, or else the first. Channels are left out if their node is not `used` (by node), or if
/// they animate the pose of a node with a matrix that is not T·R·S. preferred: a clip's name, or empty; an unknown name
/// is a usage error.
[[nodiscard]] Result<std::vector<AnimationClip>> import_animations(Document& document, std::string_view preferred,
                                                                   const std::vector<bool>& used);

}  // namespace gloam::gltf

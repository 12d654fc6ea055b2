// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>
#include <vector>

#include "engine/core/result.h"
#include "engine/scene/gltf/document.h"

namespace gloam::gltf {

/// Skins of a checked document.
[[nodiscard]] Result<std::vector<Skin>> import_skins(const Document& document);

/// All clips, in file order. Of clips that move the same property of a node only one keeps its channel: `preferred` (a
/// clip's name, or empty), else the first. Channels of nodes that are not `used`, or whose pose is no T·R·S, are left
/// out. An unknown name is a usage error.
[[nodiscard]] Result<std::vector<AnimationClip>> import_animations(Document& document, std::string_view preferred,
                                                                   const std::vector<bool>& used);

}  // namespace gloam::gltf

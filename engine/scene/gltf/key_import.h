// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <vector>

#include "engine/core/result.h"
#include "engine/ecs/world.h"
#include "engine/scene/gltf/document.h"
#include "engine/scene/gltf/json_scan.h"
#include "engine/scene/key_registry.h"

namespace gloam::gltf {

/// Refuses what the file requires and nobody reads; appends a warning for what it uses besides.
[[nodiscard]] Status check_extensions(const JsonScan& scan, const KeyRegistry& registry,
                                      std::vector<std::string>& warnings);

/// Refuses "gloam." keys on elements that take none.
[[nodiscard]] Status check_stray_keys(const JsonScan& scan, const KeyRegistry& registry);

/// Hands extensions to their readers and sets every scene key, nodes first, then materials and the scene. entities: by
/// node; keys of nodes without one are checked and not set. The assets are in the world.
[[nodiscard]] Status import_keys(const JsonScan& scan, const Document& document, std::uint32_t scene,
                                 std::span<const Entity> entities, const std::string& directory,
                                 const KeyRegistry& registry, World& world);

}  // namespace gloam::gltf

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <vector>

#include "engine/core/result.h"
#include "engine/ecs/world.h"
#include "engine/scene/gltf/document.h"
#include "engine/scene/gltf/parsing/json_scan.h"
#include "engine/scene/keys/registry.h"

namespace gloam::gltf {

/// Input error if the file requires an extension that nothing reads. Appends a warning for each unknown extension that
/// it only uses.
[[nodiscard]] Status check_extensions(const JsonScan& scan, const KeyRegistry& registry,
                                      std::vector<std::string>& warnings);

/// Input error if a "gloam." key stands on an element that takes none.
[[nodiscard]] Status check_stray_keys(const JsonScan& scan, const KeyRegistry& registry);

/// Passes extensions to their readers and sets every scene key: nodes first, then materials, then scenes. The assets
/// must be in the world. scene: index of the chosen scene; keys of other scenes are checked but not set. entities: by
/// node; keys of nodes without an entity are checked but not set.
[[nodiscard]] Status import_keys(const JsonScan& scan, const Document& document, std::uint32_t scene,
                                 std::span<const Entity> entities, const std::string& directory,
                                 const KeyRegistry& registry, World& world);

}  // namespace gloam::gltf

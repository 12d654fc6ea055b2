// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/scene/gltf/parsing/json_scan.h"

namespace gloam::gltf {

/// Whether this is an extension of materials whose effect is not drawn. The material is drawn without it.
[[nodiscard]] bool is_undrawn_extension(std::string_view name);

/// The undrawn extensions that change the look of a material of the file, each once, in alphabetical order. An
/// extension whose values have no effect (an index of refraction of 1.5, a factor of 0) is not among them.
[[nodiscard]] std::vector<std::string_view> undrawn_extensions(const JsonScan& scan);

}  // namespace gloam::gltf

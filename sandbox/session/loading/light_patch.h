// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "engine/core/result.h"
#include "engine/ecs/world.h"
#include "engine/math/types.h"

namespace gloam {

/// Changes to a light of a scene; members without a value leave the scene's.
struct LightChange {
  std::optional<float> intensity;  ///< candela; directional: lux; ≥ 0
  std::optional<vec3> color;       ///< linear RGB, ≥ 0
  std::optional<float> range_m;    ///< ≥ 0, as Light::range_m
  std::optional<float> width_m;    ///< ≥ 0, as Light::width_m
  std::optional<bool> on;          ///< false: the intensity becomes 0
  std::optional<bool> shadows;
  std::optional<bool> cookie;        ///< only false changes something
  std::optional<dvec3> translation;  ///< of the node, as in glTF
  std::optional<dquat> rotation;     ///< of the node, as in glTF; the light shines along its −Z
  bool operator==(const LightChange&) const = default;
};

/// The changes of a file for --lights, by the name of the light's node:
/// {"version": 1, "lights": {"lamp": {"intensity": 40, "color": [1, 0.9, 0.7], "range_m": 8, "width_m": 0.1, "on":
/// true, "shadows": true, "cookie": true, "translation": [0, 2, 0], "rotation": [0, 0, 0, 1]}}}. All members are
/// optional.
struct LightPatch {
  std::map<std::string, LightChange, std::less<>> lights;
  bool operator==(const LightPatch&) const = default;
};

/// Usage error with `source` for what is no patch: no JSON object, another version, unknown members, values out of
/// range.
[[nodiscard]] Result<LightPatch> parse_light_patch(std::string_view text, std::string_view source);
[[nodiscard]] std::string light_patch_text(const LightPatch& patch);

/// Usage error for a light that the world does not have, input error for a name that several of its lights have; then
/// nothing changes.
[[nodiscard]] Status apply_light_patch(World& world, const LightPatch& patch);

}  // namespace gloam

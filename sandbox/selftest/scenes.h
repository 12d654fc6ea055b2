// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/render/knobs/knobs.h"
#include "sandbox/selftest/test_scene.h"

namespace gloam {

/// A scene that calls for one effect.
struct EffectScene {
  std::string_view name;    ///< "fog"
  std::string_view effect;  ///< in words, for sentences
  TestScene (*make)() = nullptr;
  std::vector<KnobOverride> knobs = {};
  double time_s = 0.0;       ///< of the first frame
  std::uint32_t frames = 3;  ///< until the picture is judged; in the first ones, lists have no room yet
  bool symmetric = true;     ///< turned or mirrored it looks the same; blades of grass grow where they grow
  bool moves = false;        ///< it changes with time
  bool quick = false;        ///< part of the quick self-test
};

[[nodiscard]] std::span<const EffectScene> effect_scenes();
/// Asserts that there is one.
[[nodiscard]] const EffectScene& effect_scene(std::string_view name);

/// A floor, and a camera that sees it from above.
[[nodiscard]] TestScene bare_floor();

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/render/knobs/knobs.h"

namespace gloam {

/// What a wipe shows to the right of its line.
enum class WipeSide : std::uint8_t {
  exact,    ///< the most exact setting of all budgets
  kept_a,   ///< the kept settings A
  kept_b,   ///< the kept settings B
  picture,  ///< the lit picture, beside the view that is shown
  view,     ///< the view that was shown before the one that is shown
};
inline constexpr WipeSide kWipeSides[] = {WipeSide::exact, WipeSide::kept_a, WipeSide::kept_b, WipeSide::picture,
                                          WipeSide::view};

/// "exact", "A", "B", "picture", "view".
[[nodiscard]] const char* name_of(WipeSide side);

/// The picture now beside another one of the same moment, with a line between them.
struct PanelWipe {
  bool on = false;
  float at = 0.5f;  ///< of the picture's width; the other picture is to the right
  WipeSide side = WipeSide::exact;
  std::vector<KnobOverride> kept = {};  ///< of kept_a and kept_b: values of all knobs
  std::string visualizer = {};          ///< of view: its name, with its argument
  std::string note = {};                ///< what the right side shows and costs
};

/// The right side in words: name_of(), and the name of a view.
[[nodiscard]] std::string right_side(const PanelWipe& wipe);

}  // namespace gloam

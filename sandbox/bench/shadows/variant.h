// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>

#include "engine/core/result.h"
#include "sandbox/bench/shadows/case.h"

namespace gloam {

/// Knob values for one way to compute shadows.
struct ShadowVariant {
  const char* mode;            ///< shadows.mode
  const char* classify;        ///< shadows.classify
  const char* closeups = "0";  ///< closeups.max_pairs
};
inline constexpr ShadowVariant kMonolithic{"monolithic", "on"};
inline constexpr ShadowVariant kUnclassified{"deferred", "off"};
inline constexpr ShadowVariant kClassified{"deferred", "on"};
inline constexpr ShadowVariant kWithCloseups{"deferred", "on", "8"};

/// Draws with a variant until buffers have grown enough that every tile has room. Returns the last frame, which is
/// never the first one after a change of knobs. ErrorKind::failed if tiles still have no room after ten frames.
[[nodiscard]] Result<FrameSample> draw_settled(ShadowCase& shadows, const ShadowVariant& variant);

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

namespace gloam {

/// Factor from cd/m² to units in which 1 is white before the tone curve, for an exposure value at ISO 100.
[[nodiscard]] float exposure_from_ev100(float ev100);

/// Time constants of lighting.exposure=adapting, in simulated seconds: after one, 1/e of the difference in stops is
/// left. Eyes and cameras, too, are dazzled for a shorter time than they are blind.
inline constexpr double kToBrightS = 0.5;
inline constexpr double kToDarkS = 2.0;

}  // namespace gloam

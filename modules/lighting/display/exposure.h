// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

namespace gloam {

/// Factor from cd/m² to units in which 1 is white before the tone curve, for an exposure value at ISO 100.
[[nodiscard]] float exposure_from_ev100(float ev100);

}  // namespace gloam

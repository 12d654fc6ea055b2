// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/math/types.h"

namespace gloam {

/// Octahedral code, in [−1, 1]², of a unit vector. The zero vector is encoded as +Z.
[[nodiscard]] vec2 octahedral_encode(vec3 unit);
[[nodiscard]] vec3 octahedral_decode(vec2 code);

/// Octahedral normal as two signed normalised 16-bit numbers: x in the low half, y in the high half. Angle error <
/// 0.01°.
[[nodiscard]] std::uint32_t pack_normal_snorm16(vec3 unit);
[[nodiscard]] vec3 unpack_normal_snorm16(std::uint32_t packed);

/// IEEE half precision, round to nearest even, overflow to infinity, NaN kept.
[[nodiscard]] std::uint16_t float_to_half(float value);
[[nodiscard]] float half_to_float(std::uint16_t half);

}  // namespace gloam

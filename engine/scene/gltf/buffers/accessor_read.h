// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/core/result.h"
#include "engine/scene/gltf/document.h"

namespace gloam::gltf {

/// Reads all components of a checked accessor as floats, element by element. Normalised integers become 0…1 or −1…1,
/// other integers keep their value. out: exactly count · components (asserted). Input error with its place: a float
/// that is not finite, or a sparse index out of range.
[[nodiscard]] Status read_floats(const Document& document, std::uint32_t accessor, std::span<float> out);

/// Reads all components of a checked accessor of unsigned integers. out: exactly count · components (asserted). Input
/// error with its place: a sparse index out of range.
[[nodiscard]] Status read_integers(const Document& document, std::uint32_t accessor, std::span<std::uint32_t> out);

/// Reads the elements as float vectors. The accessor must have as many components as V.
template <class V>
[[nodiscard]] Status read_vectors(const Document& document, std::uint32_t accessor, std::vector<V>& out) {
  out.resize(document.accessors[accessor].count);
  return read_floats(document, accessor,
                     std::span(reinterpret_cast<float*>(out.data()), out.size() * sizeof(V) / sizeof(float)));
}

}  // namespace gloam::gltf

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/core/result.h"
#include "engine/scene/gltf/document.h"

namespace gloam::gltf {

/// All components of a checked accessor as floats, element by element: floats as they are, normalised integers in 0…1
/// or −1…1, other integers by value. out: count · components. A value that is not finite is a fault (place included).
[[nodiscard]] Status read_floats(const Document& document, std::uint32_t accessor, std::span<float> out);

/// All components of a checked accessor of unsigned integers.
[[nodiscard]] Status read_integers(const Document& document, std::uint32_t accessor, std::span<std::uint32_t> out);

/// Elements as vectors of floats; the accessor has as many components as V.
template <class V>
[[nodiscard]] Status read_vectors(const Document& document, std::uint32_t accessor, std::vector<V>& out) {
  out.resize(document.accessors[accessor].count);
  return read_floats(document, accessor,
                     std::span(reinterpret_cast<float*>(out.data()), out.size() * sizeof(V) / sizeof(float)));
}

}  // namespace gloam::gltf

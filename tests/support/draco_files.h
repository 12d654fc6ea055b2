// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <vector>

namespace gloam::test {

/// An attribute of a mesh, as an accessor of glTF describes it.
struct PlainAttribute {
  std::string name;            ///< "POSITION"
  std::uint32_t draco_id = 0;  ///< its unique id in the compressed mesh
  int component_type = 5126;   ///< glTF's number
  int components = 3;
  bool normalized = false;
  std::vector<std::uint8_t> bytes;  ///< packed elements

  [[nodiscard]] std::size_t count() const;
};

template <class T>
PlainAttribute plain_attribute(std::string name, std::uint32_t draco_id, int component_type, int components,
                               const std::vector<T>& values, bool normalized = false) {
  PlainAttribute attribute{std::move(name), draco_id, component_type, components, normalized, {}};
  attribute.bytes.resize(values.size() * sizeof(T));
  std::memcpy(attribute.bytes.data(), values.data(), attribute.bytes.size());
  return attribute;
}

struct DracoSettings {
  bool edgebreaker = true;  ///< which orders vertices anew; else the sequential method
  int position_bits = 0;    ///< of quantised positions; 0: all attributes are stored exactly
  bool with_metadata = false;
};

/// A mesh of triangles that Draco's own encoder has compressed. Every vertex must be in a triangle.
[[nodiscard]] std::vector<std::uint8_t> encode_draco(std::span<const PlainAttribute> attributes,
                                                     std::span<const std::uint32_t> indices,
                                                     const DracoSettings& settings = {});
/// The same points without triangles.
[[nodiscard]] std::vector<std::uint8_t> encode_draco_points(std::span<const PlainAttribute> attributes);

}  // namespace gloam::test

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/scene/gltf/buffers/accessor_read.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>

#include "engine/scene/gltf/place.h"
#include "engine/scene/gltf/validation/document_check.h"

namespace gloam::gltf {
namespace {

static_assert(std::endian::native == std::endian::little, "glTF's buffers are little-endian");

template <class T>
T load(const std::uint8_t* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof(T));
  return value;
}

/// Elements in a buffer, `stride` bytes apart.
struct Elements {
  const std::uint8_t* bytes = nullptr;
  std::uint64_t stride = 0;
  std::uint64_t count = 0;
  std::uint32_t components = 0;
};

template <class T>
void convert(const Elements& from, bool normalized, float* to) {
  const float scale =
      normalized && !std::is_floating_point_v<T> ? static_cast<float>(std::numeric_limits<T>::max()) : 1.0f;
  for (std::uint64_t i = 0; i < from.count; ++i) {
    const std::uint8_t* element = from.bytes + i * from.stride;
    for (std::uint32_t c = 0; c < from.components; ++c, ++to) {
      *to = static_cast<float>(load<T>(element + c * sizeof(T)));
      if (normalized) *to = std::max(*to / scale, -1.0f);
    }
  }
}

void convert_elements(const Elements& from, const Accessor& accessor, float* to) {
  const bool normalized = accessor.normalized && accessor.component_type != ComponentType::f32;
  switch (accessor.component_type) {
    case ComponentType::i8:
      return convert<std::int8_t>(from, normalized, to);
    case ComponentType::u8:
      return convert<std::uint8_t>(from, normalized, to);
    case ComponentType::i16:
      return convert<std::int16_t>(from, normalized, to);
    case ComponentType::u16:
      return convert<std::uint16_t>(from, normalized, to);
    case ComponentType::u32:
      return convert<std::uint32_t>(from, normalized, to);
    case ComponentType::f32:
      break;
  }
  const std::size_t element = from.components * sizeof(float);
  if (from.stride == element) {
    std::memcpy(to, from.bytes, from.count * element);
    return;
  }
  for (std::uint64_t i = 0; i < from.count; ++i)
    std::memcpy(to + i * from.components, from.bytes + i * from.stride, element);
}

void convert_elements(const Elements& from, const Accessor& accessor, std::uint32_t* to) {
  const std::uint64_t size = component_size(accessor.component_type);
  for (std::uint64_t i = 0; i < from.count; ++i) {
    for (std::uint32_t c = 0; c < from.components; ++c, ++to) {
      const std::uint8_t* bytes = from.bytes + i * from.stride + c * size;
      *to = size == 1 ? *bytes : size == 2 ? load<std::uint16_t>(bytes) : load<std::uint32_t>(bytes);
    }
  }
}

const std::uint8_t* bytes_at(const Document& document, std::uint32_t view, std::uint64_t offset) {
  const BufferView& source = document.views[view];
  return document.buffers[source.buffer].data() + source.offset + offset;
}

std::uint32_t sparse_index(const std::uint8_t* bytes, ComponentType type, std::uint64_t i) {
  if (type == ComponentType::u8) return bytes[i];
  if (type == ComponentType::u16) return load<std::uint16_t>(bytes + 2 * i);
  return load<std::uint32_t>(bytes + 4 * i);
}

/// Writes the sparse elements over `out`. Their indices are checked only here, because they lie in the buffer; false if
/// one is out of range.
template <class T>
bool replace_sparse(const Document& document, const Accessor& accessor, std::span<T> out) {
  const SparseSource& sparse = *accessor.sparse;
  const std::uint8_t* indices = bytes_at(document, sparse.index_view, sparse.index_offset);
  const std::uint8_t* values = bytes_at(document, sparse.value_view, sparse.value_offset);
  const std::uint64_t size = component_size(accessor.component_type) * accessor.components;
  for (std::uint64_t i = 0; i < sparse.count; ++i) {
    const std::uint32_t index = sparse_index(indices, sparse.index_type, i);
    if (index >= accessor.count) return false;
    convert_elements({values + i * size, size, 1, accessor.components}, accessor,
                     out.data() + std::uint64_t{index} * accessor.components);
  }
  return true;
}

template <class T>
bool read_all(const Document& document, const Accessor& accessor, std::span<T> out) {
  if (accessor.view == kNone) {
    std::fill(out.begin(), out.end(), T(0));
  } else {
    const std::uint64_t packed = component_size(accessor.component_type) * accessor.components;
    const std::uint64_t stride = document.views[accessor.view].stride;
    convert_elements({bytes_at(document, accessor.view, accessor.offset), stride == 0 ? packed : stride, accessor.count,
                      accessor.components},
                     accessor, out.data());
  }
  return !accessor.sparse || replace_sparse(document, accessor, out);
}

Error sparse_fault(std::uint32_t accessor) {
  return fault_at(place("accessor", accessor), "a sparse index is not below its count");
}

}  // namespace

Status read_floats(const Document& document, std::uint32_t accessor, std::span<float> out) {
  const Accessor& source = document.accessors[accessor];
  GLOAM_ASSERT(out.size() == source.count * source.components, "the output holds every component of the accessor");
  if (!read_all(document, source, out)) return sparse_fault(accessor);
  if (source.component_type != ComponentType::f32) return {};
  const auto wrong = std::find_if(out.begin(), out.end(), [](float value) { return !std::isfinite(value); });
  if (wrong == out.end()) return {};
  return fault_at(place("accessor", accessor),
                  "element " + std::to_string((wrong - out.begin()) / source.components) + " is not finite");
}

Status read_integers(const Document& document, std::uint32_t accessor, std::span<std::uint32_t> out) {
  const Accessor& source = document.accessors[accessor];
  GLOAM_ASSERT(out.size() == source.count * source.components, "the output holds every component of the accessor");
  if (!read_all(document, source, out)) return sparse_fault(accessor);
  return {};
}

}  // namespace gloam::gltf

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/scene/gltf/buffers/compressed_views.h"

#include <meshoptimizer.h>

#include <string>
#include <utility>
#include <vector>

#include "engine/scene/gltf/place.h"
#include "engine/scene/gltf/validation/document_check.h"

namespace gloam::gltf {
namespace {

using Mode = CompressedSource::Mode;
using Filter = CompressedSource::Filter;

// The codec spends at least a byte on 64 elements of each of their bytes, and on each index.
constexpr std::uint64_t kBestRatio = 64;

Error view_fault(std::string sentence) { return {ErrorKind::input, std::move(sentence)}; }

/// Checks what the decoders require of their arguments.
Status check_form(const CompressedSource& source) {
  const bool index = source.mode != Mode::attributes;
  const bool stride_fits = index ? source.stride == 2 || source.stride == 4
                                 : source.stride >= 4 && source.stride <= 256 && source.stride % 4 == 0;
  if (!stride_fits) return view_fault("byteStride " + std::to_string(source.stride) + " does not fit its mode");
  if (source.mode == Mode::triangles && source.count % 3 != 0)
    return view_fault("count must be a multiple of 3 for triangles, is " + std::to_string(source.count));
  if (source.filter == Filter::none) return {};
  const bool filter_fits =
      source.mode == Mode::attributes && (source.filter == Filter::exponential || source.stride == 8 ||
                                          (source.filter == Filter::octahedral && source.stride == 4));
  if (!filter_fits) return view_fault("its filter does not fit its mode and byteStride");
  return {};
}

Status check_range(const CompressedSource& source, std::uint64_t buffer_size) {
  if (source.offset > buffer_size || source.length > buffer_size - source.offset)
    return view_fault("it ends past its buffer of " + std::to_string(buffer_size) + " bytes");
  if (source.count == 0 || source.count > kBestRatio * source.length / source.stride)
    return view_fault("count is " + std::to_string(source.count) + ", which its " + std::to_string(source.length) +
                      " bytes cannot hold");
  return {};
}

bool decode_elements(const CompressedSource& source, const std::uint8_t* bytes, std::uint8_t* out) {
  switch (source.mode) {
    case Mode::attributes:
      return meshopt_decodeVertexBuffer(out, source.count, source.stride, bytes, source.length) == 0;
    case Mode::triangles:
      return meshopt_decodeIndexBuffer(out, source.count, source.stride, bytes, source.length) == 0;
    case Mode::indices:
      return meshopt_decodeIndexSequence(out, source.count, source.stride, bytes, source.length) == 0;
  }
  return false;
}

void apply_filter(const CompressedSource& source, std::uint8_t* out) {
  switch (source.filter) {
    case Filter::none:
      break;
    case Filter::octahedral:
      meshopt_decodeFilterOct(out, source.count, source.stride);
      break;
    case Filter::quaternion:
      meshopt_decodeFilterQuat(out, source.count, source.stride);
      break;
    case Filter::exponential:
      meshopt_decodeFilterExp(out, source.count, source.stride);
      break;
  }
}

}  // namespace

Status decompress_views(Document& document, std::uint64_t file_bytes) {
  std::uint64_t left = import_budget(bytes_read(document, file_bytes));
  for (std::size_t i = 0; i < document.views.size(); ++i) {
    BufferView& view = document.views[i];
    if (!view.compressed) continue;
    const CompressedSource& source = *view.compressed;
    const std::string where = place("buffer view", i) + ", EXT_meshopt_compression";
    if (const Status status = check_form(source); !status) return fault_at(where, status.error().message);
    const std::vector<std::uint8_t>& buffer = document.buffers[source.buffer];
    if (const Status status = check_range(source, buffer.size()); !status)
      return fault_at(where, status.error().message);
    const std::uint64_t size = source.count * source.stride;
    if (size > left) return fault_at(where, "the decoded views take more memory than the files justify");
    if (view.length > size)
      return fault_at(where,
                      "it holds " + std::to_string(size) + " bytes, but the view has " + std::to_string(view.length));
    left -= size;
    std::vector<std::uint8_t> decoded(size);
    if (!decode_elements(source, buffer.data() + source.offset, decoded.data()))
      return fault_at(where, "it is damaged");
    apply_filter(source, decoded.data());
    view.buffer = static_cast<std::uint32_t>(document.buffers.size());
    view.offset = 0;
    document.buffers.push_back(std::move(decoded));
  }
  return {};
}

}  // namespace gloam::gltf

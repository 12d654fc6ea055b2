// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "engine/render/declare/compute_pass.h"
#include "engine/render/frame_builder.h"

namespace gloam {

/// Bytes of a buffer with `count` packed 8-bit keys: a multiple of 16, > 0.
[[nodiscard]] constexpr std::uint64_t packed_key_bytes(std::uint32_t count) {
  return count == 0 ? 16 : (std::uint64_t{count} + 15) / 16 * 16;
}

/// Results of add_radix_sort_passes().
struct SortedKeys {
  BufferRef values;  ///< count × uint, in the order of their keys; equal keys keep their order
  BufferRef keys;    ///< sorted, packed as the input; if no later pass reads them, they are not made
  /// 257 × uint, the exclusive prefix sum of the histogram: the keys of value k are at bins[k] … bins[k + 1] − 1.
  BufferRef bins;
};

/// Adds the passes of a stable radix sort of 8-bit keys by one digit: a histogram for each column of keys, an exclusive
/// prefix sum over all, a scatter. Nothing depends on the subgroup width.
/// name: prefix of the passes' and buffers' names. keys: key i is byte i % 4 of word i / 4; packed_key_bytes(count)
/// bytes, those past the last key with any content. values: count × uint, or null: value i is i. count: of keys, at
/// most 2²⁵; with 0 the bins are 0, and keys may be null.
[[nodiscard]] SortedKeys add_radix_sort_passes(FrameBuilder& frame, std::string_view name, BufferRef keys,
                                               BufferRef values, std::uint32_t count);

/// The programs of these passes, for Module::pipelines. threads_in_turn: see gpu::DeviceInfo. implied_values: values
/// are null.
[[nodiscard]] std::vector<ComputeProgram> radix_sort_programs(bool threads_in_turn, bool implied_values);

}  // namespace gloam

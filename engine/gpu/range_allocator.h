// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <optional>

namespace gloam::gpu {

/// Allocates ranges from one span of bytes: best fit, and adjacent free ranges are merged. Not thread-safe.
class RangeAllocator {
 public:
  explicit RangeAllocator(std::uint64_t size);

  /// Returns the offset of a range of `size` bytes (> 0), a multiple of `alignment` (a power of two); nullopt if no
  /// free range is large enough.
  [[nodiscard]] std::optional<std::uint64_t> allocate(std::uint64_t size, std::uint64_t alignment);
  /// Frees a range. `offset`: returned by `allocate` and not freed since.
  void free(std::uint64_t offset);

  [[nodiscard]] std::uint64_t size() const { return size_; }
  [[nodiscard]] std::uint64_t used_bytes() const { return used_bytes_; }
  [[nodiscard]] std::uint64_t largest_free() const;
  [[nodiscard]] bool empty() const { return used_.empty(); }

 private:
  std::uint64_t size_ = 0;
  std::uint64_t used_bytes_ = 0;
  std::map<std::uint64_t, std::uint64_t> free_;  // offset → size; adjacent ranges are merged
  std::map<std::uint64_t, std::uint64_t> used_;  // offset → size
};

}  // namespace gloam::gpu

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <optional>

namespace gloam::gpu {

/// Hands out ranges of one span of bytes: best fit, free neighbours are merged. Not thread-safe.
class RangeAllocator {
 public:
  explicit RangeAllocator(std::uint64_t size);

  /// Offset of `size` bytes (> 0), a multiple of `alignment` (a power of two); none when no free range is large enough.
  [[nodiscard]] std::optional<std::uint64_t> allocate(std::uint64_t size, std::uint64_t alignment);
  /// `offset` as `allocate` gave it, once.
  void free(std::uint64_t offset);

  [[nodiscard]] std::uint64_t size() const { return size_; }
  [[nodiscard]] std::uint64_t used_bytes() const { return used_bytes_; }
  [[nodiscard]] std::uint64_t largest_free() const;
  [[nodiscard]] bool empty() const { return used_.empty(); }

 private:
  std::uint64_t size_ = 0;
  std::uint64_t used_bytes_ = 0;
  std::map<std::uint64_t, std::uint64_t> free_;  // offset → size; no two touch
  std::map<std::uint64_t, std::uint64_t> used_;  // offset → size
};

}  // namespace gloam::gpu

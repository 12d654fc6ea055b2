// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <utility>

namespace gloam {

/// Allocates ranges from a row of units (bytes, elements) that can grow. Best fit: takes the smallest free range that
/// is large enough, of several the first one, so large free ranges are kept. Adjacent free ranges are merged. Not
/// thread-safe.
class RangeAllocator {
 public:
  RangeAllocator() = default;
  explicit RangeAllocator(std::uint64_t capacity) { grow(capacity); }

  /// Returns the first unit of a range of `count` units (≥ 1), a multiple of `alignment` (a power of two); nullopt if
  /// no free range is large enough. Units before an aligned range stay free.
  [[nodiscard]] std::optional<std::uint64_t> allocate(std::uint64_t count, std::uint64_t alignment = 1);
  /// Frees a range. first: returned by allocate() and not freed since; asserts otherwise.
  void free(std::uint64_t first);
  /// Adds free units at the end. capacity: not less than before.
  void grow(std::uint64_t capacity);

  [[nodiscard]] std::uint64_t capacity() const { return capacity_; }
  /// Allocated units.
  [[nodiscard]] std::uint64_t used() const { return used_; }
  [[nodiscard]] bool empty() const { return used_ == 0; }
  /// Length of the free range that ends at the capacity; 0 if the last unit is in use.
  [[nodiscard]] std::uint64_t free_at_end() const;

 private:
  using Ranges = std::map<std::uint64_t, std::uint64_t>;  ///< first unit → count

  void add_free(std::uint64_t first, std::uint64_t count);
  void insert_free(std::uint64_t first, std::uint64_t count);
  void erase_free(Ranges::iterator range);

  Ranges free_;
  Ranges allocated_;
  std::set<std::pair<std::uint64_t, std::uint64_t>> free_by_count_;  ///< (count, first unit)
  std::uint64_t capacity_ = 0;
  std::uint64_t used_ = 0;
};

}  // namespace gloam

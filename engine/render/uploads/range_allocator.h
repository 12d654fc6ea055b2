// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <utility>

namespace gloam {

/// Places ranges in a row of units that can grow. Takes the smallest free range that is large enough, so a scene whose
/// meshes come and go keeps its large free ranges. Free neighbours are one range.
class RangeAllocator {
 public:
  /// The first unit of `count` free units; none if no free range is large enough. count: ≥ 1.
  [[nodiscard]] std::optional<std::uint64_t> allocate(std::uint64_t count);
  /// Gives back what allocate() has returned for `count`.
  void free(std::uint64_t first, std::uint64_t count);
  /// Adds free units at the end. capacity: not less than before.
  void grow(std::uint64_t capacity);

  [[nodiscard]] std::uint64_t capacity() const { return capacity_; }
  [[nodiscard]] std::uint64_t used() const { return used_; }
  /// Length of the free range that ends at the capacity; 0 if the last unit is in use.
  [[nodiscard]] std::uint64_t free_at_end() const;

 private:
  void insert(std::uint64_t first, std::uint64_t count);
  void erase(std::map<std::uint64_t, std::uint64_t>::iterator range);

  std::map<std::uint64_t, std::uint64_t> free_;                      ///< first unit → count
  std::set<std::pair<std::uint64_t, std::uint64_t>> free_by_count_;  ///< (count, first unit)
  std::uint64_t capacity_ = 0;
  std::uint64_t used_ = 0;
};

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <limits>
#include <memory>
#include <span>
#include <type_traits>
#include <vector>

#include "engine/core/assert.h"

namespace gloam {

/// Linear allocator for data that lives until the next reset: frame scratch, a loader's tables. It grows in blocks, so
/// spans keep their address. Single allocations are never freed and no destructor runs. Use it from one thread at a
/// time.
class Arena {
 public:
  static constexpr std::size_t kDefaultBlockBytes = std::size_t{64} * 1024;

  /// block_bytes: size of the first block, > 0. The block is taken from the heap at the first allocation.
  explicit Arena(std::size_t block_bytes = kDefaultBlockBytes);
  Arena(const Arena&) = delete;
  Arena& operator=(const Arena&) = delete;

  /// Returns `size` uninitialised bytes. alignment: a power of two. Never null; allocations of size > 0 have distinct
  /// addresses.
  [[nodiscard]] std::byte* allocate_bytes(std::size_t size, std::size_t alignment);

  /// Returns `count` value-initialised items (zero for plain types).
  template <class T>
  requires std::is_trivially_destructible_v<T>
  [[nodiscard]] std::span<T> make_span(std::size_t count) {
    if (count == 0) return {};
    T* items = raw<T>(count);
    std::uninitialized_value_construct_n(items, count);
    return {items, count};
  }

  /// Returns a copy of `items`.
  template <class T>
  requires std::is_trivially_destructible_v<T>
  [[nodiscard]] std::span<T> copy(std::span<const T> items) {
    if (items.empty()) return {};
    T* copies = raw<T>(items.size());
    std::uninitialized_copy(items.begin(), items.end(), copies);
    return {copies, items.size()};
  }

  /// Invalidates all allocations. Memory is kept: several blocks are replaced by one of their total size, so that a
  /// repeated workload needs no further block after its first round.
  void reset();

  /// Bytes handed out since the last reset, alignment gaps included.
  [[nodiscard]] std::size_t used_bytes() const;
  /// Bytes taken from the heap.
  [[nodiscard]] std::size_t reserved_bytes() const;

 private:
  struct Block {
    std::unique_ptr<std::byte[]> memory;
    std::size_t size = 0;
    std::size_t used = 0;
  };

  template <class T>
  T* raw(std::size_t count) {
    GLOAM_ASSERT(count <= std::numeric_limits<std::size_t>::max() / sizeof(T), "an arena span's bytes fit in size_t");
    return reinterpret_cast<T*>(allocate_bytes(count * sizeof(T), alignof(T)));
  }
  void add_block(std::size_t size);

  std::size_t next_block_bytes_;
  std::vector<Block> blocks_;  // allocations come from the last block; the others are full
};

}  // namespace gloam

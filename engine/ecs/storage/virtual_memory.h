// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

#include "engine/core/assert.h"
#include "engine/core/cpu_allocator.h"

namespace gloam {

/// A range of reserved address space. It has no memory until pages of it are committed and written to, and it never
/// moves. With a host's allocator it is memory of that, as a whole and from the start. Move-only.
/// The operating system's memory functions are behind system_pages.h.
class ReservedMemory {
 public:
  ReservedMemory() = default;
  /// Reserves at least `bytes`, starting on a page boundary. Throws std::bad_alloc when the address space or the number
  /// of mappings is used up.
  explicit ReservedMemory(std::size_t bytes, CpuAllocator* allocator = nullptr);
  ~ReservedMemory();
  ReservedMemory(ReservedMemory&& other) noexcept
      : data_(std::exchange(other.data_, nullptr)),
        bytes_(std::exchange(other.bytes_, 0)),
        writable_(other.writable_),
        allocator_(other.allocator_) {}
  ReservedMemory& operator=(ReservedMemory&& other) noexcept {
    std::swap(data_, other.data_);
    std::swap(bytes_, other.bytes_);
    std::swap(writable_, other.writable_);
    std::swap(allocator_, other.allocator_);
    return *this;
  }

  [[nodiscard]] std::byte* data() const { return data_; }
  [[nodiscard]] std::size_t size() const { return bytes_; }

  /// Makes the bytes [begin, end) of the reservation readable, writable and zero. Both bounds are multiples of
  /// page_size(), and the range is not yet committed. Throws std::bad_alloc when memory is used up.
  void commit(std::size_t begin, std::size_t end);

  /// A part of the reservation that is committed from its begin onwards. Offsets in bytes, multiples of page_size().
  struct Stretch {
    std::size_t begin = 0;
    std::size_t limit = 0;      ///< end of the part
    std::size_t committed = 0;  ///< end of the committed bytes, which start at `begin`
  };
  /// Commits a stretch at least up to `end`, in whole pages. From about half a large page on it commits large pages,
  /// and asks the system to back the bytes already committed with large pages too: long columns then cause fewer TLB
  /// misses.
  void extend(Stretch& stretch, std::size_t end);

  [[nodiscard]] static std::size_t page_size();

  /// Assumed size of the system's large pages; a wrong value costs speed only. Reservations of at least this size begin
  /// at a multiple of it.
  static constexpr std::size_t kLargePage = std::size_t{2} << 20;

 private:
  std::byte* data_ = nullptr;
  std::size_t bytes_ = 0;
  bool writable_ = false;              ///< all pages are, also those that are not committed
  CpuAllocator* allocator_ = nullptr;  ///< that `data_` is from; null: the system
};

[[nodiscard]] constexpr std::size_t round_up(std::size_t value, std::size_t multiple) {
  return (value + multiple - 1) / multiple * multiple;
}

/// Allocates small pieces of memory side by side. They never move and are all freed together, by the destructor.
class PackedMemory {
 public:
  /// allocator: null for memory of the system.
  explicit PackedMemory(CpuAllocator* allocator = nullptr) : allocator_(allocator) {}
  /// Returns `bytes` zeroed bytes, aligned to 64.
  [[nodiscard]] std::byte* take(std::size_t bytes);

 private:
  struct Block {
    ReservedMemory memory;
    ReservedMemory::Stretch stretch;
  };
  CpuAllocator* allocator_;
  std::vector<Block> blocks_;
  std::size_t used_ = 0;  ///< bytes used of the last block
};

/// An array that grows up to a fixed limit without moving its items. Items are trivially copyable.
template <class T>
class VirtualArray {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  explicit VirtualArray(std::size_t max_items, CpuAllocator* allocator = nullptr)
      : memory_(max_items * sizeof(T), allocator), stretch_{.limit = memory_.size()}, max_items_(max_items) {}

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] T& operator[](std::size_t i) { return items()[i]; }
  [[nodiscard]] const T& operator[](std::size_t i) const { return items()[i]; }

  /// Makes room for `count` items in total; count ≤ max_items.
  void reserve(std::size_t count) {
    if (count > capacity_) grow(count);
  }
  void push_back(const T& item) {
    if (size_ == capacity_) grow(size_ + 1);
    items()[size_++] = item;
  }

 private:
  [[nodiscard]] T* items() const { return reinterpret_cast<T*>(memory_.data()); }

  void grow(std::size_t count) {
    GLOAM_ASSERT(count <= max_items_, "an array of fixed reservation is full: raise its limit");
    const std::size_t bytes = (count > capacity_ * 2 ? count : capacity_ * 2) * sizeof(T);
    memory_.extend(stretch_, bytes < memory_.size() ? bytes : memory_.size());
    capacity_ = stretch_.committed / sizeof(T) < max_items_ ? stretch_.committed / sizeof(T) : max_items_;
  }

  ReservedMemory memory_;
  ReservedMemory::Stretch stretch_;
  std::size_t max_items_ = 0;
  std::size_t size_ = 0;
  std::size_t capacity_ = 0;  ///< items that fit into the committed bytes
};

}  // namespace gloam

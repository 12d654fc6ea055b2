// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "tests/soak/live_heap.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <new>

// Of the linker: the ends of the program's code.
extern "C" const char __executable_start, etext;

namespace {

std::atomic<std::int64_t> program = 0, libraries = 0;

/// Lies before each allocation.
struct Header {
  void* begin = nullptr;
  std::uint64_t size_and_owner = 0;  ///< bytes · 2, + 1 for those of the program
};

std::atomic<std::int64_t>& bytes_of(std::uint64_t size_and_owner) {
  return size_and_owner % 2 == 1 ? program : libraries;
}

void* take(std::size_t size, std::size_t alignment, const void* caller) {
  alignment = std::max(alignment, sizeof(Header));
  // The header fits into what the alignment leaves free before the allocation.
  auto* begin = static_cast<std::byte*>(
      std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment + alignment));
  if (begin == nullptr) return nullptr;
  const bool is_program = caller >= &__executable_start && caller < &etext;
  std::byte* memory = begin + alignment;
  const Header header = {begin, 2 * size + (is_program ? 1 : 0)};
  *(reinterpret_cast<Header*>(memory) - 1) = header;
  bytes_of(header.size_and_owner).fetch_add(static_cast<std::int64_t>(size), std::memory_order_relaxed);
  return memory;
}
void* take_or_throw(std::size_t size, std::size_t alignment, const void* caller) {
  void* made = take(size, alignment, caller);
  if (made == nullptr) throw std::bad_alloc();
  return made;
}
void give_back(void* memory) {
  if (memory == nullptr) return;
  const Header header = *(static_cast<Header*>(memory) - 1);
  bytes_of(header.size_and_owner)
      .fetch_sub(static_cast<std::int64_t>(header.size_and_owner / 2), std::memory_order_relaxed);
  std::free(header.begin);
}

}  // namespace

namespace gloam::soak {
LiveHeap live_heap() { return {program.load(), libraries.load()}; }
}  // namespace gloam::soak

// All forms, because those of the library that call others would hide who calls.
#define GLOAM_CALLER __builtin_return_address(0)
void* operator new(std::size_t size) { return take_or_throw(size, 1, GLOAM_CALLER); }
void* operator new[](std::size_t size) { return take_or_throw(size, 1, GLOAM_CALLER); }
void* operator new(std::size_t size, const std::nothrow_t&) noexcept { return take(size, 1, GLOAM_CALLER); }
void* operator new[](std::size_t size, const std::nothrow_t&) noexcept { return take(size, 1, GLOAM_CALLER); }
void* operator new(std::size_t size, std::align_val_t alignment) {
  return take_or_throw(size, static_cast<std::size_t>(alignment), GLOAM_CALLER);
}
void* operator new[](std::size_t size, std::align_val_t alignment) {
  return take_or_throw(size, static_cast<std::size_t>(alignment), GLOAM_CALLER);
}
void* operator new(std::size_t size, std::align_val_t alignment, const std::nothrow_t&) noexcept {
  return take(size, static_cast<std::size_t>(alignment), GLOAM_CALLER);
}
void* operator new[](std::size_t size, std::align_val_t alignment, const std::nothrow_t&) noexcept {
  return take(size, static_cast<std::size_t>(alignment), GLOAM_CALLER);
}
#undef GLOAM_CALLER
void operator delete(void* memory) noexcept { give_back(memory); }
void operator delete[](void* memory) noexcept { give_back(memory); }
void operator delete(void* memory, std::size_t) noexcept { give_back(memory); }
void operator delete[](void* memory, std::size_t) noexcept { give_back(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { give_back(memory); }
void operator delete[](void* memory, std::align_val_t) noexcept { give_back(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { give_back(memory); }
void operator delete[](void* memory, std::size_t, std::align_val_t) noexcept { give_back(memory); }

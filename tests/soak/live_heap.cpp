// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "tests/soak/live_heap.h"

#include <malloc.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <new>

namespace {

std::atomic<std::int64_t> live = 0;

void* take(std::size_t size, std::size_t alignment) {
  // aligned_alloc wants a multiple of the alignment.
  void* made =
      alignment <= alignof(std::max_align_t)
          ? std::malloc(std::max<std::size_t>(size, 1))
          : std::aligned_alloc(alignment, (std::max<std::size_t>(size, 1) + alignment - 1) / alignment * alignment);
  if (made != nullptr) live.fetch_add(static_cast<std::int64_t>(malloc_usable_size(made)), std::memory_order_relaxed);
  return made;
}
void* take_or_throw(std::size_t size, std::size_t alignment) {
  void* made = take(size, alignment);
  if (made == nullptr) throw std::bad_alloc();
  return made;
}
void give_back(void* memory) {
  if (memory == nullptr) return;
  live.fetch_sub(static_cast<std::int64_t>(malloc_usable_size(memory)), std::memory_order_relaxed);
  std::free(memory);
}

}  // namespace

namespace gloam::soak {
std::int64_t live_heap_bytes() { return live.load(); }
}  // namespace gloam::soak

// The forms that are not here call one of these.
void* operator new(std::size_t size) { return take_or_throw(size, 1); }
void* operator new(std::size_t size, const std::nothrow_t&) noexcept { return take(size, 1); }
void* operator new(std::size_t size, std::align_val_t alignment) {
  return take_or_throw(size, static_cast<std::size_t>(alignment));
}
void* operator new(std::size_t size, std::align_val_t alignment, const std::nothrow_t&) noexcept {
  return take(size, static_cast<std::size_t>(alignment));
}
void operator delete(void* memory) noexcept { give_back(memory); }
void operator delete(void* memory, std::size_t) noexcept { give_back(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { give_back(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { give_back(memory); }

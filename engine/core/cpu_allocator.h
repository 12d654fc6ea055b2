// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

namespace gloam {

/// A host's allocator of CPU memory. Called from any thread that changes a world.
class CpuAllocator {
 public:
  virtual ~CpuAllocator() = default;
  /// Returns `bytes` (> 0) uninitialised bytes, aligned to `alignment`, a power of two up to the page size; null if
  /// there is no memory.
  [[nodiscard]] virtual void* allocate(std::size_t bytes, std::size_t alignment) = 0;
  /// memory: from allocate, with the same bytes and alignment.
  virtual void free(void* memory, std::size_t bytes, std::size_t alignment) noexcept = 0;
};

}  // namespace gloam

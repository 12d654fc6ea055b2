// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/core/arena.h"

#include <algorithm>
#include <bit>
#include <cstdint>

namespace gloam {
namespace {

std::size_t gap_before(const std::byte* address, std::size_t alignment) {
  return (alignment - (reinterpret_cast<std::uintptr_t>(address) & (alignment - 1))) & (alignment - 1);
}

}  // namespace

Arena::Arena(std::size_t block_bytes) : next_block_bytes_(block_bytes) {
  GLOAM_ASSERT(block_bytes > 0, "an arena's first block has at least one byte");
}

std::byte* Arena::allocate_bytes(std::size_t size, std::size_t alignment) {
  GLOAM_ASSERT(std::has_single_bit(alignment), "an arena's alignment is a power of two");
  GLOAM_ASSERT(size <= std::numeric_limits<std::size_t>::max() - alignment, "an arena allocation fits in size_t");
  if (!blocks_.empty()) {
    Block& block = blocks_.back();
    const std::size_t begin = block.used + gap_before(block.memory.get() + block.used, alignment);
    if (begin <= block.size && size <= block.size - begin) {
      block.used = begin + size;
      return block.memory.get() + begin;
    }
  }
  add_block(size + alignment - 1);
  Block& block = blocks_.back();
  const std::size_t begin = gap_before(block.memory.get(), alignment);
  block.used = begin + size;
  return block.memory.get() + begin;
}

void Arena::add_block(std::size_t size) {
  const std::size_t bytes = std::max({size, next_block_bytes_, std::size_t{1}});
  // for_overwrite: clearing a block that is about to be filled would cost as much as filling it.
  blocks_.push_back({std::make_unique_for_overwrite<std::byte[]>(bytes), bytes, 0});
  next_block_bytes_ = bytes <= std::numeric_limits<std::size_t>::max() / 2 ? bytes * 2 : bytes;
}

void Arena::reset() {
  if (blocks_.size() > 1) {
    const std::size_t total = reserved_bytes();
    blocks_.clear();
    next_block_bytes_ = total;
    add_block(total);
  }
  if (!blocks_.empty()) blocks_.back().used = 0;
}

std::size_t Arena::used_bytes() const {
  std::size_t total = 0;
  for (const Block& block : blocks_) total += block.used;
  return total;
}

std::size_t Arena::reserved_bytes() const {
  std::size_t total = 0;
  for (const Block& block : blocks_) total += block.size;
  return total;
}

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "engine/frame/declaration.h"
#include "engine/gpu/types.h"

namespace gloam::frame {

constexpr std::uint32_t kNone = ~0u;

/// One resource's barrier; the fields are those of gpu::ImageBarrier and gpu::BufferBarrier.
struct PlannedBarrier {
  std::uint32_t resource = 0;
  gpu::Access before = gpu::Access::none;
  gpu::Access after = gpu::Access::none;
  gpu::AccessMask also_before = 0;
  gpu::AccessMask also_after = 0;
};

/// A pass that is executed, and its stretch of Plan::barriers.
struct PlannedPass {
  std::uint32_t pass = 0;  ///< in the declaration
  std::uint32_t first_barrier = 0;
  std::uint32_t barrier_count = 0;
};

/// What the plan knows of each declared resource. Times are indices into Plan::passes; kNone when no live pass uses it.
struct ResourceLife {
  std::uint32_t first = kNone;
  std::uint32_t last = kNone;
  std::uint32_t first_barrier = kNone;  ///< before the first use; kNone when none is needed
  gpu::AccessMask ending = 0;           ///< what whoever comes next must wait for
  std::uint32_t slot = kNone;           ///< of a transient: in Plan::image_slots or Plan::buffer_slots
  std::uint32_t image_usage = 0;        ///< gpu::ImageUsage flags of all live accesses
  std::uint32_t buffer_usage = 0;       ///< gpu::BufferUsage flags of all live accesses
};

/// Transient resources that take turns in one piece of memory, in order of their lives.
struct MemorySlot {
  std::vector<std::uint32_t> resources;
  std::uint64_t bytes = 0;
};

/// What one structure of a frame comes to. Holds no handles, so frames with other imports can use it.
struct Plan {
  std::vector<PlannedPass> passes;  ///< live ones in order of declaration
  std::vector<PlannedBarrier> barriers;
  std::uint32_t first_final_barrier = 0;  ///< from here on: after the last pass
  std::vector<ResourceLife> lives;        ///< one a declared resource
  std::vector<MemorySlot> image_slots;    ///< images of one slot share memory
  std::vector<MemorySlot> buffer_slots;   ///< buffers of one slot are one buffer, all of the same size
  std::uint64_t transient_bytes = 0;
  std::uint64_t unshared_bytes = 0;
};

/// Culls, places barriers and shares memory, from nothing but the declaration.
/// A pass lives when it is kept, writes an import, or writes what a living pass after it touches.
/// A resource's uses form epochs: one write, or neighbouring reads that need no layout change between them. One barrier
/// stands before an epoch, names all its accesses, and waits for all accesses of the epoch before.
[[nodiscard]] Plan compile_plan(const Declaration& declaration);

/// Gives transients of disjoint lives common slots: images by memory, buffers of equal size by object. A transient's
/// first barrier then waits for the one before it in the slot, and for larger ones before that; the first in the slot
/// waits for the last ones, which used the memory in the frame before.
void share_memory(const Declaration& declaration, Plan& plan);

}  // namespace gloam::frame

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "engine/core/result.h"
#include "engine/frame/declaration.h"
#include "engine/gpu/device.h"
#include "engine/gpu/types.h"

namespace gloam::frame {

constexpr std::uint32_t kNone = ~0u;

/// A barrier on one resource. The fields have the same meaning as in gpu::ImageBarrier and gpu::BufferBarrier.
struct PlannedBarrier {
  std::uint32_t resource = 0;
  gpu::Access before = gpu::Access::none;
  gpu::Access after = gpu::Access::none;
  gpu::AccessMask also_before = 0;
  gpu::AccessMask also_after = 0;
  gpu::ImageRange range;  ///< default: the whole resource
};

/// A pass that is executed, and its range in Plan::barriers.
struct PlannedPass {
  std::uint32_t pass = 0;  ///< index into Declaration::passes
  std::uint32_t first_barrier = 0;
  std::uint32_t barrier_count = 0;
};

/// The lifetime and the needs of one declared resource. `first` and `last` are indices into Plan::passes; kNone if no
/// live pass uses the resource.
struct ResourceLife {
  std::uint32_t first = kNone;
  std::uint32_t last = kNone;
  std::uint32_t first_barrier = kNone;  ///< index of the first of its Plan::barriers; kNone: none needed
  gpu::AccessMask ending = 0;           ///< accesses that the next user of the memory must wait for
  std::uint32_t slot = kNone;           ///< of a transient: index into Plan::image_slots or Plan::buffer_slots
  std::uint32_t image_usage = 0;        ///< gpu::ImageUsage flags of all live accesses
  std::uint32_t buffer_usage = 0;       ///< gpu::BufferUsage flags of all live accesses
};

/// Transient resources that use one piece of memory one after another, in order of their lifetimes.
struct MemorySlot {
  std::vector<std::uint32_t> resources;
  std::uint64_t bytes = 0;    ///< of the largest resource
  std::uint32_t largest = 0;  ///< of `resources`: the largest; the first one of equals
  std::uint32_t heap = 0;     ///< index into Plan::heaps
  std::uint64_t offset = 0;   ///< bytes from the begin of the heap
};

/// Memory of one kind for all slots that need this kind.
struct HeapNeed {
  std::uint32_t types = 0;  ///< as in gpu::MemoryNeeds
  std::uint64_t bytes = 0;
};

/// The compiled plan of one frame structure. It holds no handles, so frames with other imports can use it.
struct Plan {
  std::vector<PlannedPass> passes;  ///< live passes in order of declaration
  std::vector<PlannedBarrier> barriers;
  std::uint32_t first_final_barrier = 0;  ///< barriers from this index on come after the last pass
  std::vector<ResourceLife> lives;        ///< one per declared resource
  std::vector<MemorySlot> image_slots;    ///< the images of one slot share memory
  std::vector<MemorySlot> buffer_slots;   ///< all buffers of one slot have one size and are one buffer object
  std::vector<HeapNeed> heaps;            ///< one per kind of memory; slots of one heap do not overlap
  gpu::AccessMask endings = 0;            ///< accesses that the next plan in the same memory must wait for
  std::uint64_t transient_bytes = 0;      ///< total of all slots
  std::uint64_t unshared_bytes = 0;       ///< total without sharing: one slot per transient
};

/// Culls passes, places barriers and shares memory. The plan depends on the declaration only.
/// A pass is live if it is kept, writes an import, or writes a resource that a later live pass uses.
/// The uses of a resource form epochs: an epoch is one write, or consecutive reads that need no layout change between
/// them. One barrier precedes each epoch. It names all accesses of the epoch and waits for all accesses of the previous
/// epoch. Mips and layers of an image that passes use as such have epochs each. Equal barriers of neighbours are
/// joined. The first barriers of all mips and layers stand before the image's first pass, so that no pass waits for
/// another one that writes other mips or layers.
///
/// With a device, sizes and kinds of memory are the device's, and the call fails if it supports an image or a buffer
/// not. Without a device, resources are packed and fit one kind of memory.
[[nodiscard]] Plan compile_plan(const Declaration& declaration);
[[nodiscard]] Result<Plan> compile_plan(const Declaration& declaration, const gpu::Device& device);

/// The descriptions of a transient image, and of the buffer object of a slot, with the usage flags of all live
/// accesses.
[[nodiscard]] gpu::ImageDesc image_desc_of(const Declaration& declaration, const Plan& plan, std::uint32_t resource);
[[nodiscard]] gpu::BufferDesc buffer_desc_of(const Declaration& declaration, const Plan& plan, const MemorySlot& slot);

/// Assigns transients with disjoint lifetimes to common slots: images of one kind of memory share memory, buffers of
/// equal size share one object. A transient's first barriers wait for the previous user of the slot, and for larger
/// users before that one. The first user of a slot waits for the last users in the previous frame. device: null as in
/// compile_plan.
[[nodiscard]] Status share_memory(const Declaration& declaration, const gpu::Device* device, Plan& plan);

}  // namespace gloam::frame

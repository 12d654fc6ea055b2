// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/frame/planning/plan_cache.h"

#include <algorithm>
#include <string>
#include <utility>

namespace gloam::frame {

namespace {

const gpu::MemoryHandle kNoMemory;

/// The bytes of a plan's slots in one heap, by module of their largest resource, which the memory is there for.
std::vector<gpu::ModuleMemory> shares_of(const Declaration& declaration, const Plan& plan, std::uint32_t heap) {
  std::vector<gpu::ModuleMemory> shares;
  const auto add = [&](const std::string& module, std::uint64_t bytes) {
    const auto found = std::ranges::find(shares, module, &gpu::ModuleMemory::module);
    if (found == shares.end()) {
      shares.push_back({module, bytes});
    } else {
      found->bytes += bytes;
    }
  };
  for (const MemorySlot& slot : plan.image_slots) {
    if (slot.heap == heap) add(declaration.resources[slot.largest].image_desc.module, slot.bytes);
  }
  for (const MemorySlot& slot : plan.buffer_slots) {
    if (slot.heap == heap) add(declaration.resources[slot.largest].buffer_desc.module, slot.bytes);
  }
  return shares;
}

}  // namespace

PlanCache::~PlanCache() {
  for (const auto& plan : plans_) destroy_objects(*plan);
  destroy_unshared(heaps_, {});
}

Result<CachedPlan*> PlanCache::get(const Declaration& declaration, std::uint64_t hash) {
  ++uses_;
  const Result<CachedPlan*> found = find_or_compile(declaration, hash);
  if (!found.ok()) return found.error();
  CachedPlan& entry = **found;
  entry.last_used = uses_;
  entry.wants_memory = true;
  for (const auto& plan : plans_) {
    if (plan->last_used + kUsesBeforeMemoryIsFreed >= uses_) continue;
    plan->wants_memory = false;
    destroy_objects(*plan);
  }
  const Status made = give_memory(declaration, entry);
  if (!made.ok()) {
    entry.wants_memory = false;  // so that other plans do not fail too
    return made.error();
  }
  account(declaration, entry);
  return &entry;
}

Status PlanCache::give_memory(const Declaration& declaration, CachedPlan& entry) {
  std::vector<Heap> needed = needed_heaps();
  if (!heaps_are(needed)) return rebuild(declaration, std::move(needed), entry);
  if (entry.has_objects) return {};
  Result<PlanObjects> objects = make_objects(declaration, entry.plan, heaps_);
  if (!objects.ok()) return objects.error();
  entry.objects = std::move(*objects);
  entry.has_objects = true;
  return {};
}

Result<CachedPlan*> PlanCache::find_or_compile(const Declaration& declaration, std::uint64_t hash) {
  const auto found = std::ranges::find_if(plans_, [&](const auto& plan) {
    // Comparing the number of resources keeps indices in range if two structures ever have the same hash.
    return plan->hash == hash && plan->plan.lives.size() == declaration.resources.size();
  });
  if (found != plans_.end()) return found->get();
  Result<Plan> compiled = compile_plan(declaration, device_);
  if (!compiled.ok()) return compiled.error();
  if (plans_.size() == kPlansKept) {
    const auto oldest = std::ranges::min_element(plans_, {}, [](const auto& plan) { return plan->last_used; });
    destroy_objects(**oldest);
    plans_.erase(oldest);
  }
  plans_.push_back(std::make_unique<CachedPlan>());
  plans_.back()->hash = hash;
  plans_.back()->serial = ++plans_compiled_;
  plans_.back()->plan = std::move(*compiled);
  return plans_.back().get();
}

gpu::AccessMask PlanCache::begin_execution(const CachedPlan& plan) {
  // The last frame of the same plan has waited for all plans before it, and its barriers wait for that frame.
  const gpu::AccessMask others = plan.serial == executed_ ? 0 : past_endings_;
  executed_ = plan.serial;
  past_endings_ |= plan.plan.endings;
  return others;
}

std::vector<PlanCache::Heap> PlanCache::needed_heaps() const {
  std::vector<Heap> needed;
  for (const auto& plan : plans_) {
    if (!plan->wants_memory) continue;
    for (const HeapNeed& need : plan->plan.heaps) {
      const auto heap = std::ranges::find(needed, need.types, &Heap::types);
      if (heap == needed.end()) {
        needed.push_back({need.types, need.bytes, kNoMemory});
      } else {
        heap->bytes = std::max(heap->bytes, need.bytes);
      }
    }
  }
  return needed;
}

bool PlanCache::heaps_are(const std::vector<Heap>& needed) const {
  return needed.size() == heaps_.size() && std::ranges::all_of(needed, [&](const Heap& heap) {
           const auto found = std::ranges::find(heaps_, heap.types, &Heap::types);
           return found != heaps_.end() && found->bytes == heap.bytes;
         });
}

Status PlanCache::rebuild(const Declaration& declaration, std::vector<Heap> needed, CachedPlan& entry) {
  Result<PlanObjects> objects = Error{};
  Status made = make_heaps(needed);
  if (made.ok()) {
    objects = make_objects(declaration, entry.plan, needed);
    if (!objects.ok()) made = objects.error();
  }
  if (!made.ok()) {
    destroy_unshared(needed, heaps_);
    return made;
  }
  for (const auto& plan : plans_) destroy_objects(*plan);
  destroy_unshared(heaps_, needed);
  heaps_ = std::move(needed);
  entry.objects = std::move(*objects);
  entry.has_objects = true;
  accounted_ = 0;
  return {};
}

/// Takes over the heaps of the same size and allocates the others.
Status PlanCache::make_heaps(std::vector<Heap>& heaps) const {
  for (Heap& heap : heaps) {
    const auto same = std::ranges::find_if(
        heaps_, [&](const Heap& old) { return old.types == heap.types && old.bytes == heap.bytes; });
    if (same != heaps_.end()) {
      heap.memory = same->memory;
      continue;
    }
    Result<gpu::MemoryHandle> memory = device_.create_memory(
        {.name = "transient memory", .module = "engine", .size = heap.bytes, .types = heap.types});
    if (!memory.ok()) return memory.error();
    heap.memory = *memory;
  }
  return {};
}

Result<PlanObjects> PlanCache::make_objects(const Declaration& declaration, const Plan& plan,
                                            const std::vector<Heap>& heaps) const {
  PlanObjects objects;
  objects.images.assign(declaration.resources.size(), {});
  objects.buffers.assign(declaration.resources.size(), {});
  const Status filled = fill(declaration, plan, heaps, objects);
  if (filled.ok()) return objects;
  destroy(plan, objects);
  return filled.error();
}

Status PlanCache::fill(const Declaration& declaration, const Plan& plan, const std::vector<Heap>& heaps,
                       PlanObjects& objects) const {
  const auto place_of = [&](const MemorySlot& slot) {
    const auto heap = std::ranges::find(heaps, plan.heaps[slot.heap].types, &Heap::types);
    return gpu::MemoryPlace{heap->memory, slot.offset};
  };
  for (const MemorySlot& slot : plan.image_slots) {
    for (std::uint32_t r : slot.resources) {
      Result<gpu::ImageHandle> image = device_.create_image(image_desc_of(declaration, plan, r), place_of(slot));
      if (!image.ok()) return image.error();
      objects.images[r] = *image;
    }
  }
  for (const MemorySlot& slot : plan.buffer_slots) {
    Result<gpu::BufferHandle> buffer = device_.create_buffer(buffer_desc_of(declaration, plan, slot), place_of(slot));
    if (!buffer.ok()) return buffer.error();
    for (std::uint32_t r : slot.resources) objects.buffers[r] = *buffer;
  }
  return {};
}

void PlanCache::account(const Declaration& declaration, const CachedPlan& entry) {
  if (accounted_ == entry.serial) return;
  accounted_ = entry.serial;
  for (const Heap& heap : heaps_) {
    const auto need = std::ranges::find(entry.plan.heaps, heap.types, &HeapNeed::types);
    const bool used = need != entry.plan.heaps.end();
    const auto index = static_cast<std::uint32_t>(need - entry.plan.heaps.begin());
    device_.account(heap.memory, used ? shares_of(declaration, entry.plan, index) : std::vector<gpu::ModuleMemory>());
  }
}

void PlanCache::destroy(const Plan& plan, const PlanObjects& objects) const {
  for (gpu::ImageHandle image : objects.images) {
    if (image) device_.destroy(image);
  }
  for (const MemorySlot& slot : plan.buffer_slots) {
    const gpu::BufferHandle buffer = objects.buffers[slot.resources.front()];
    if (buffer) device_.destroy(buffer);
  }
}

void PlanCache::destroy_objects(CachedPlan& entry) {
  if (!entry.has_objects) return;
  destroy(entry.plan, entry.objects);
  entry.objects = {};
  entry.has_objects = false;
}

/// Frees the heaps whose memory no heap of `kept` has.
void PlanCache::destroy_unshared(const std::vector<Heap>& heaps, const std::vector<Heap>& kept) const {
  for (const Heap& heap : heaps) {
    if (heap.memory && std::ranges::find(kept, heap.memory, &Heap::memory) == kept.end()) device_.destroy(heap.memory);
  }
}

void PlanCache::free_memory_except(CachedPlan* kept, const Declaration& declaration) {
  for (const auto& plan : plans_) {
    if (plan.get() == kept) continue;
    plan->wants_memory = false;
    destroy_objects(*plan);
  }
  if (kept == nullptr) {
    destroy_unshared(heaps_, {});
    heaps_.clear();
    accounted_ = 0;
    return;
  }
  std::vector<Heap> needed = needed_heaps();
  if (heaps_are(needed)) return;
  if (rebuild(declaration, std::move(needed), *kept).ok()) account(declaration, *kept);
}

}  // namespace gloam::frame

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/frame/plan_cache.h"

#include <algorithm>

namespace gloam::frame {

PlanCache::~PlanCache() { free_memory_except(nullptr); }

Result<CachedPlan*> PlanCache::get(const Declaration& declaration, std::uint64_t hash) {
  ++uses_;
  CachedPlan& entry = find_or_compile(declaration, hash);
  entry.last_used = uses_;
  for (const auto& plan : plans_) {
    if (plan->last_used + kUsesBeforeMemoryIsFreed < uses_) free_memory(*plan);
  }
  if (entry.has_memory) return &entry;
  entry.images.assign(declaration.resources.size(), {});
  entry.buffers.assign(declaration.resources.size(), {});
  entry.has_memory = true;
  Status made = make_images(declaration, entry);
  if (made.ok()) made = make_buffers(declaration, entry);
  if (made.ok()) return &entry;
  free_memory(entry);
  return made.error();
}

CachedPlan& PlanCache::find_or_compile(const Declaration& declaration, std::uint64_t hash) {
  const auto found = std::ranges::find_if(plans_, [&](const auto& plan) {
    // Comparing the number of resources keeps indices in range if two structures ever have the same hash.
    return plan->hash == hash && plan->plan.lives.size() == declaration.resources.size();
  });
  if (found != plans_.end()) return **found;
  if (plans_.size() == kPlansKept) {
    const auto oldest = std::ranges::min_element(plans_, {}, [](const auto& plan) { return plan->last_used; });
    free_memory(**oldest);
    plans_.erase(oldest);
  }
  ++plans_compiled_;
  plans_.push_back(std::make_unique<CachedPlan>());
  plans_.back()->hash = hash;
  plans_.back()->plan = compile_plan(declaration);
  return *plans_.back();
}

Status PlanCache::make_images(const Declaration& declaration, CachedPlan& entry) {
  std::vector<gpu::ImageDesc> descs;
  for (const MemorySlot& slot : entry.plan.image_slots) {
    descs.clear();
    for (std::uint32_t r : slot.resources) {
      descs.push_back(declaration.resources[r].image_desc);
      descs.back().usage = descs.back().usage | static_cast<gpu::ImageUsage>(entry.plan.lives[r].image_usage);
    }
    if (descs.size() == 1) {
      Result<gpu::ImageHandle> image = device_.create_image(descs.front());
      if (!image.ok()) return image.error();
      entry.images[slot.resources.front()] = *image;
      continue;
    }
    Result<std::vector<gpu::ImageHandle>> images = device_.create_aliased_images(descs);
    if (!images.ok()) return images.error();
    for (std::size_t i = 0; i < descs.size(); ++i) entry.images[slot.resources[i]] = (*images)[i];
  }
  return {};
}

Status PlanCache::make_buffers(const Declaration& declaration, CachedPlan& entry) {
  for (const MemorySlot& slot : entry.plan.buffer_slots) {
    gpu::BufferDesc desc = declaration.resources[slot.resources.front()].buffer_desc;
    for (std::uint32_t r : slot.resources) {
      desc.usage = desc.usage | declaration.resources[r].buffer_desc.usage |
                   static_cast<gpu::BufferUsage>(entry.plan.lives[r].buffer_usage);
    }
    Result<gpu::BufferHandle> buffer = device_.create_buffer(desc);
    if (!buffer.ok()) return buffer.error();
    for (std::uint32_t r : slot.resources) entry.buffers[r] = *buffer;
  }
  return {};
}

void PlanCache::free_memory(CachedPlan& entry) {
  if (!entry.has_memory) return;
  for (gpu::ImageHandle image : entry.images) {
    if (image) device_.destroy(image);
  }
  for (const MemorySlot& slot : entry.plan.buffer_slots) {
    const gpu::BufferHandle buffer = entry.buffers[slot.resources.front()];
    if (buffer) device_.destroy(buffer);
  }
  entry.images.clear();
  entry.buffers.clear();
  entry.has_memory = false;
}

void PlanCache::free_memory_except(const CachedPlan* kept) {
  for (const auto& plan : plans_) {
    if (plan.get() != kept) free_memory(*plan);
  }
}

}  // namespace gloam::frame

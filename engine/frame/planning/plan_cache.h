// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "engine/core/result.h"
#include "engine/frame/planning/plan.h"
#include "engine/gpu/device.h"

namespace gloam::frame {

/// The images and buffers of a plan's transients, by declared resource; none for imports and unused resources.
struct PlanObjects {
  std::vector<gpu::ImageHandle> images;
  std::vector<gpu::BufferHandle> buffers;
};

struct CachedPlan {
  std::uint64_t hash = 0;
  std::uint64_t serial = 0;  ///< different for all plans that a cache has ever compiled
  std::uint64_t last_used = 0;
  Plan plan;
  bool wants_memory = false;  ///< the heaps have room for it
  bool has_objects = false;
  PlanObjects objects;
};

/// The plans of the kPlansKept most recently used structures, so that toggling between them compiles nothing, and the
/// memory of their transients. All plans lie in the same memory, one heap per kind of memory, which is as large as the
/// largest plan needs: a plan that fits allocates nothing. If a plan does not fit, the heaps are made anew. A plan that
/// is not used for kUsesBeforeMemoryIsFreed calls of get() stays compiled, but the heaps shrink to what the other plans
/// need.
class PlanCache {
 public:
  static constexpr std::size_t kPlansKept = 8;
  static constexpr std::uint64_t kUsesBeforeMemoryIsFreed = 60;

  explicit PlanCache(gpu::Device& device) : device_(device) {}
  ~PlanCache();
  PlanCache(const PlanCache&) = delete;
  PlanCache& operator=(const PlanCache&) = delete;

  /// Returns the plan of this structure with its objects; both are created if they do not exist. Valid until the next
  /// call. Fails if the device cannot create the memory; the next call tries again.
  [[nodiscard]] Result<CachedPlan*> get(const Declaration& declaration, std::uint64_t hash);
  /// Call it when the plan is recorded. Returns the accesses for which the first barriers of its transients must wait
  /// in addition: those of other plans that used the memory since this one did.
  [[nodiscard]] gpu::AccessMask begin_execution(const CachedPlan& plan);
  /// Call it when the GPU does not execute the last recorded plan: the next one waits for all plans before it.
  void give_up_execution() { executed_ = 0; }
  /// Shrinks the memory to the needs of `kept`, the plan of this declaration; null: to nothing. If the device cannot
  /// create the smaller memory, the memory stays.
  void free_memory_except(CachedPlan* kept, const Declaration& declaration);
  [[nodiscard]] std::uint64_t plans_compiled() const { return plans_compiled_; }

 private:
  struct Heap {
    std::uint32_t types = 0;
    std::uint64_t bytes = 0;
    gpu::MemoryHandle memory;
  };
  [[nodiscard]] Result<CachedPlan*> find_or_compile(const Declaration& declaration, std::uint64_t hash);
  /// The heaps that all plans together need, without memory.
  [[nodiscard]] std::vector<Heap> needed_heaps() const;
  [[nodiscard]] bool heaps_are(const std::vector<Heap>& needed) const;
  /// Makes the heaps and the objects of `entry` that are missing.
  [[nodiscard]] Status give_memory(const Declaration& declaration, CachedPlan& entry);
  /// Makes heaps as needed and the objects of `entry` in them. All other plans lose their objects.
  [[nodiscard]] Status rebuild(const Declaration& declaration, std::vector<Heap> needed, CachedPlan& entry);
  [[nodiscard]] Status make_heaps(std::vector<Heap>& heaps) const;
  [[nodiscard]] Result<PlanObjects> make_objects(const Declaration& declaration, const Plan& plan,
                                                 const std::vector<Heap>& heaps) const;
  [[nodiscard]] Status fill(const Declaration& declaration, const Plan& plan, const std::vector<Heap>& heaps,
                            PlanObjects& objects) const;
  void account(const Declaration& declaration, const CachedPlan& entry);
  void destroy_objects(CachedPlan& entry);
  void destroy(const Plan& plan, const PlanObjects& objects) const;
  void destroy_unshared(const std::vector<Heap>& heaps, const std::vector<Heap>& kept) const;

  gpu::Device& device_;
  std::vector<std::unique_ptr<CachedPlan>> plans_;
  std::vector<Heap> heaps_;
  std::uint64_t uses_ = 0;
  std::uint64_t plans_compiled_ = 0;
  std::uint64_t accounted_ = 0;       ///< serial of the plan whose modules the heaps are accounted to
  std::uint64_t executed_ = 0;        ///< serial of the plan that was executed last; 0: none
  gpu::AccessMask past_endings_ = 0;  ///< of all plans that were executed
};

}  // namespace gloam::frame

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "engine/core/result.h"
#include "engine/frame/plan.h"
#include "engine/gpu/device.h"

namespace gloam::frame {

/// A plan and the memory of its transients. Handles are indexed by declared resource; there is none for imports and
/// unused resources.
struct CachedPlan {
  std::uint64_t hash = 0;
  std::uint64_t last_used = 0;
  Plan plan;
  bool has_memory = false;
  std::vector<gpu::ImageHandle> images;
  std::vector<gpu::BufferHandle> buffers;
};

/// The plans of the kPlansKept most recently used structures, so that toggling between them compiles nothing. A plan
/// that is not used for kUsesBeforeMemoryIsFreed calls of get() frees its memory but stays compiled.
class PlanCache {
 public:
  static constexpr std::size_t kPlansKept = 8;
  static constexpr std::uint64_t kUsesBeforeMemoryIsFreed = 60;

  explicit PlanCache(gpu::Device& device) : device_(device) {}
  ~PlanCache();
  PlanCache(const PlanCache&) = delete;
  PlanCache& operator=(const PlanCache&) = delete;

  /// Returns the plan of this structure with its memory; both are created if they do not exist. Valid until the next
  /// call. Fails if the device cannot create the memory; the next call tries again.
  [[nodiscard]] Result<CachedPlan*> get(const Declaration& declaration, std::uint64_t hash);
  /// Frees the memory of all plans but `kept`.
  void free_memory_except(const CachedPlan* kept);
  [[nodiscard]] std::uint64_t plans_compiled() const { return plans_compiled_; }

 private:
  [[nodiscard]] CachedPlan& find_or_compile(const Declaration& declaration, std::uint64_t hash);
  [[nodiscard]] Status make_images(const Declaration& declaration, CachedPlan& entry);
  [[nodiscard]] Status make_buffers(const Declaration& declaration, CachedPlan& entry);
  void free_memory(CachedPlan& entry);

  gpu::Device& device_;
  std::vector<std::unique_ptr<CachedPlan>> plans_;
  std::uint64_t uses_ = 0;
  std::uint64_t plans_compiled_ = 0;
};

}  // namespace gloam::frame

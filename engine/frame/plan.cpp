// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/frame/plan.h"

#include "engine/gpu/access.h"

namespace gloam::frame {

namespace {

using gpu::Access;
using gpu::AccessMask;
using gpu::mask_of;

/// The accesses of one resource since its last barrier, while the passes are visited in order.
struct Epoch {
  AccessMask accesses = 0;
  bool writes = false;
  std::uint32_t barrier = kNone;  ///< index of the epoch's barrier; kNone: an import's state before the frame
};

std::vector<bool> find_live_passes(const Declaration& declaration) {
  std::vector<bool> needed(declaration.resources.size(), false);
  std::vector<bool> live(declaration.passes.size(), false);
  for (std::uint32_t p = declaration.passes.size(); p-- > 0;) {
    const DeclaredPass& pass = declaration.passes[p];
    const auto uses = declaration.uses_of(pass);
    bool alive = pass.keep;
    for (const DeclaredUse& use : uses) {
      alive = alive || (use.writes && (needed[use.resource] || declaration.resources[use.resource].imported));
    }
    live[p] = alive;
    if (!alive) continue;
    for (const DeclaredUse& use : uses) needed[use.resource] = true;
  }
  return live;
}

PlannedBarrier make_barrier(std::uint32_t resource, AccessMask before, AccessMask after) {
  const Access first_before = gpu::first_of(before);
  const Access first_after = gpu::first_of(after);
  return {.resource = resource,
          .before = first_before,
          .after = first_after,
          .also_before = before & ~mask_of(first_before),
          .also_after = after & ~mask_of(first_after)};
}

/// Whether the accesses may join the epoch: all are reads, for images of one layout. The epoch's barrier may not cover
/// them yet.
bool same_epoch(const Epoch& epoch, AccessMask accesses, bool writes, bool is_image) {
  if (epoch.writes || writes || epoch.accesses == 0) return false;
  return !is_image || gpu::layout_of(gpu::first_of(epoch.accesses)) == gpu::layout_of(gpu::first_of(accesses));
}

class BarrierPlacer {
 public:
  BarrierPlacer(const Declaration& declaration, Plan& plan)
      : declaration_(declaration), plan_(plan), epochs_(declaration.resources.size()) {
    for (std::uint32_t r = 0; r < declaration.resources.size(); ++r) {
      const DeclaredResource& resource = declaration.resources[r];
      if (!resource.imported) continue;
      epochs_[r] = {.accesses = mask_of(resource.before), .writes = gpu::is_write(resource.before), .barrier = kNone};
    }
  }

  void use(std::uint32_t resource, AccessMask accesses, bool writes) {
    Epoch& epoch = epochs_[resource];
    if (!same_epoch(epoch, accesses, writes, declaration_.resources[resource].is_image)) {
      return begin_epoch(resource, accesses, writes);
    }
    const AccessMask unseen = accesses & ~epoch.accesses;
    if (unseen == 0) return;
    if (epoch.barrier != kNone) {
      plan_.barriers[epoch.barrier].also_after |= unseen;
      epoch.accesses |= unseen;
    } else {
      begin_epoch(resource, epoch.accesses | unseen, false);
    }
  }

  /// Adds the barriers after the last pass, which leave each import ready for its `after` access.
  void finish() {
    plan_.first_final_barrier = static_cast<std::uint32_t>(plan_.barriers.size());
    for (std::uint32_t r = 0; r < declaration_.resources.size(); ++r) {
      const DeclaredResource& resource = declaration_.resources[r];
      plan_.lives[r].ending = epochs_[r].accesses;
      if (!resource.imported || resource.after == Access::none) continue;
      // The owner knows of this access only, so all other accesses must have ended.
      if (epochs_[r].accesses != mask_of(resource.after)) begin_epoch(r, mask_of(resource.after), false);
    }
  }

 private:
  void begin_epoch(std::uint32_t resource, AccessMask accesses, bool writes) {
    const auto barrier = static_cast<std::uint32_t>(plan_.barriers.size());
    plan_.barriers.push_back(make_barrier(resource, epochs_[resource].accesses, accesses));
    epochs_[resource] = {.accesses = accesses, .writes = writes, .barrier = barrier};
    ResourceLife& life = plan_.lives[resource];
    if (life.first_barrier == kNone) life.first_barrier = barrier;
  }

  const Declaration& declaration_;
  Plan& plan_;
  std::vector<Epoch> epochs_;
};

void add_usage(ResourceLife& life, const DeclaredUse& use, bool is_image) {
  gpu::for_each_access(use.accesses, [&](Access access) {
    if (is_image) {
      life.image_usage |= static_cast<std::uint32_t>(gpu::image_usage_of(access));
    } else {
      life.buffer_usage |= static_cast<std::uint32_t>(gpu::buffer_usage_of(access));
    }
  });
}

}  // namespace

Plan compile_plan(const Declaration& declaration) {
  Plan plan;
  plan.lives.resize(declaration.resources.size());
  const std::vector<bool> live = find_live_passes(declaration);
  BarrierPlacer placer(declaration, plan);
  for (std::uint32_t p = 0; p < declaration.passes.size(); ++p) {
    if (!live[p]) continue;
    const auto time = static_cast<std::uint32_t>(plan.passes.size());
    const auto first_barrier = static_cast<std::uint32_t>(plan.barriers.size());
    for (const DeclaredUse& use : declaration.uses_of(declaration.passes[p])) {
      ResourceLife& life = plan.lives[use.resource];
      if (life.first == kNone) life.first = time;
      life.last = time;
      add_usage(life, use, declaration.resources[use.resource].is_image);
      placer.use(use.resource, use.accesses, use.writes);
    }
    const auto barrier_end = static_cast<std::uint32_t>(plan.barriers.size());
    plan.passes.push_back({.pass = p, .first_barrier = first_barrier, .barrier_count = barrier_end - first_barrier});
  }
  placer.finish();
  share_memory(declaration, plan);
  return plan;
}

}  // namespace gloam::frame

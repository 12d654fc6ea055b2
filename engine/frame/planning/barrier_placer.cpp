// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/frame/planning/barrier_placer.h"

#include <algorithm>
#include <numeric>

#include "engine/core/assert.h"
#include "engine/gpu/access.h"
#include "engine/gpu/subresources.h"

namespace gloam::frame {

namespace {

using gpu::Access;
using gpu::AccessMask;
using gpu::ImageRange;
using gpu::mask_of;

PlannedBarrier make_barrier(std::uint32_t resource, AccessMask before, AccessMask after, const ImageRange& range) {
  const Access first_before = gpu::first_of(before);
  const Access first_after = gpu::first_of(after);
  return {.resource = resource,
          .before = first_before,
          .after = first_after,
          .also_before = before & ~mask_of(first_before),
          .also_after = after & ~mask_of(first_after),
          .range = range};
}

/// Appends `b` to `a` if the two ranges together are a range.
bool append(ImageRange& a, const ImageRange& b) {
  const bool same_mips = a.first_mip == b.first_mip && a.mip_count == b.mip_count;
  const bool same_layers = a.first_layer == b.first_layer && a.layer_count == b.layer_count;
  if (same_mips && a.first_layer + a.layer_count == b.first_layer) {
    a.layer_count += b.layer_count;
    return true;
  }
  if (same_layers && a.first_mip + a.mip_count == b.first_mip) {
    a.mip_count += b.mip_count;
    return true;
  }
  return false;
}

}  // namespace

BarrierPlacer::BarrierPlacer(const Declaration& declaration, Plan& plan)
    : declaration_(declaration), plan_(plan), tracks_(declaration.resources.size()) {
  for (std::uint32_t r = 0; r < declaration.resources.size(); ++r) {
    const DeclaredResource& resource = declaration.resources[r];
    if (resource.is_image) {
      tracks_[r].mips = resource.image_desc.mips;
      tracks_[r].layers = resource.image_desc.layers;
    }
    Epoch& epoch = tracks_[r].epochs.emplace_back();
    if (resource.imported) epoch = {.accesses = mask_of(resource.before), .writes = gpu::is_write(resource.before)};
  }
}

/// The accesses may join the epoch if all are reads, for images of one layout. Otherwise, or if the epoch's barrier
/// cannot be extended to cover them, they need a barrier.
BarrierPlacer::Need BarrierPlacer::need_of(std::uint32_t resource, Epoch& epoch, AccessMask accesses, bool writes) {
  Need need{.barrier = true, .early = !epoch.used, .writes = writes, .before = epoch.accesses, .after = accesses};
  epoch.used = true;
  if (epoch.writes || writes || epoch.accesses == 0) return need;
  const bool one_layout = !declaration_.resources[resource].is_image ||
                          gpu::layout_of(gpu::first_of(epoch.accesses)) == gpu::layout_of(gpu::first_of(accesses));
  if (!one_layout) return need;
  const AccessMask unseen = accesses & ~epoch.accesses;
  if (unseen == 0) return {};
  need.after |= epoch.accesses;
  if (epoch.barrier == kNone) return need;
  plan_.barriers[epoch.barrier].also_after |= unseen;
  epoch.accesses |= unseen;
  return {};
}

void BarrierPlacer::use(const DeclaredUse& use) {
  Track& track = tracks_[use.resource];
  const bool whole = use.range == ImageRange();
  if (!whole) split(use.resource);
  needs_.assign(track.epochs.size(), {});
  const ImageRange range = gpu::resolve(use.range, track.mips, track.layers);
  if (!track.split()) {
    needs_.front() = need_of(use.resource, track.epochs.front(), use.accesses, use.writes);
    return add_barriers(use.resource, needs_);
  }
  for (std::uint32_t m = range.first_mip; m < range.first_mip + range.mip_count; ++m) {
    for (std::uint32_t l = range.first_layer; l < range.first_layer + range.layer_count; ++l) {
      const std::size_t part = std::size_t{m} * track.layers + l;
      const bool written = track.epochs[part].accesses != 0 || declaration_.resources[use.resource].imported;
      GLOAM_ASSERT(written || use.writes, "resource '" + declaration_.resources[use.resource].name() + "': mip " +
                                              std::to_string(m) + " of layer " + std::to_string(l) +
                                              " is read that no pass has written");
      needs_[part] = need_of(use.resource, track.epochs[part], use.accesses, use.writes);
    }
  }
  add_barriers(use.resource, needs_);
}

void BarrierPlacer::split(std::uint32_t resource) {
  Track& track = tracks_[resource];
  if (!track.split()) track.epochs.assign(std::size_t{track.mips} * track.layers, Epoch(track.epochs.front()));
}

/// Adds one barrier for each rectangle of equal needs. Clears the needs.
void BarrierPlacer::add_barriers(std::uint32_t resource, std::vector<Need>& needs) {
  Track& track = tracks_[resource];
  const std::uint32_t layers = track.split() ? track.layers : 1;
  const auto mips = static_cast<std::uint32_t>(needs.size()) / layers;
  for (std::uint32_t m = 0; m < mips; ++m) {
    for (std::uint32_t l = 0; l < layers; ++l) {
      const Need need = needs[std::size_t{m} * layers + l];
      if (!need.barrier) continue;
      const auto row_is_equal = [&](std::uint32_t mip, std::uint32_t first, std::uint32_t end) {
        const auto row = needs.begin() + static_cast<std::ptrdiff_t>(std::size_t{mip} * layers);
        return std::all_of(row + first, row + end, [&](const Need& other) { return other == need; });
      };
      std::uint32_t layer_end = l + 1;
      while (layer_end < layers && row_is_equal(m, layer_end, layer_end + 1)) ++layer_end;
      std::uint32_t mip_end = m + 1;
      while (mip_end < mips && row_is_equal(mip_end, l, layer_end)) ++mip_end;
      const ImageRange range{m, mip_end - m, l, layer_end - l};
      const std::uint32_t barrier = add_barrier(resource, track.split() ? range : ImageRange(), need);
      for (std::uint32_t i = m; i < mip_end; ++i) {
        for (std::uint32_t j = l; j < layer_end; ++j) {
          needs[std::size_t{i} * layers + j] = {};
          track.epochs[std::size_t{i} * layers + j] = {
              .accesses = need.after, .writes = need.writes, .used = true, .barrier = barrier};
        }
      }
    }
  }
}

std::uint32_t BarrierPlacer::add_barrier(std::uint32_t resource, const ImageRange& range, const Need& need) {
  const PlannedBarrier barrier = make_barrier(resource, need.before, need.after, range);
  const std::uint32_t time = need.early ? plan_.lives[resource].first : time_;
  if (range != ImageRange()) {
    const std::uint32_t joined = join(barrier, time);
    if (joined != kNone) return joined;
  }
  plan_.barriers.push_back(barrier);
  times_.push_back(time);
  return static_cast<std::uint32_t>(plan_.barriers.size() - 1);
}

/// Extends an equal barrier of a neighbouring range. Returns its index, or kNone if there is none.
std::uint32_t BarrierPlacer::join(const PlannedBarrier& barrier, std::uint32_t time) {
  for (std::uint32_t i = 0; i < plan_.barriers.size(); ++i) {
    PlannedBarrier& other = plan_.barriers[i];
    if (times_[i] != time || other.range == ImageRange()) continue;
    PlannedBarrier same = barrier;
    same.range = other.range;
    const bool equal = same.resource == other.resource && same.before == other.before && same.after == other.after &&
                       same.also_before == other.also_before && same.also_after == other.also_after;
    if (equal && append(other.range, barrier.range)) return i;
  }
  return kNone;
}

void BarrierPlacer::finish() {
  time_ = static_cast<std::uint32_t>(plan_.passes.size());
  for (std::uint32_t r = 0; r < declaration_.resources.size(); ++r) {
    const DeclaredResource& resource = declaration_.resources[r];
    Track& track = tracks_[r];
    const AccessMask after = mask_of(resource.after);
    needs_.assign(track.epochs.size(), {});
    for (std::size_t part = 0; part < track.epochs.size(); ++part) {
      const AccessMask accesses = track.epochs[part].accesses;
      plan_.lives[r].ending |= accesses;
      // The owner knows of this access only, so all other accesses must have ended.
      const bool needed = resource.imported && resource.after != Access::none && accesses != after;
      if (needed) needs_[part] = {.barrier = true, .before = accesses, .after = after};
    }
    add_barriers(r, needs_);
  }
  order_barriers();
}

void BarrierPlacer::order_barriers() {
  std::vector<std::uint32_t> order(plan_.barriers.size());
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::stable_sort(order, {}, [&](std::uint32_t i) { return times_[i]; });
  std::vector<PlannedBarrier> ordered;
  ordered.reserve(order.size());
  for (std::uint32_t i : order) {
    PlannedBarrier& barrier = ordered.emplace_back(plan_.barriers[i]);
    const auto at = static_cast<std::uint32_t>(ordered.size() - 1);
    if (times_[i] < plan_.passes.size()) ++plan_.passes[times_[i]].barrier_count;
    const Track& track = tracks_[barrier.resource];
    if (barrier.range == ImageRange{0, track.mips, 0, track.layers}) barrier.range = {};
    ResourceLife& life = plan_.lives[barrier.resource];
    if (life.first_barrier == kNone) life.first_barrier = at;
  }
  std::uint32_t first = 0;
  for (PlannedPass& pass : plan_.passes) {
    pass.first_barrier = first;
    first += pass.barrier_count;
  }
  plan_.first_final_barrier = first;
  plan_.barriers = std::move(ordered);
}

}  // namespace gloam::frame

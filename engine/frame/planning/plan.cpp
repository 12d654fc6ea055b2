// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/frame/planning/plan.h"

#include <algorithm>

#include "engine/core/assert.h"
#include "engine/frame/planning/barrier_placer.h"
#include "engine/gpu/access.h"
#include "engine/gpu/subresources.h"

namespace gloam::frame {

namespace {

using gpu::Access;

/// The ranges of a resource that later live passes use.
using Ranges = std::vector<gpu::ImageRange>;

bool any_overlap(const Ranges& ranges, const gpu::ImageRange& written, const gpu::ImageDesc& desc) {
  return std::ranges::any_of(ranges, [&](const gpu::ImageRange& range) {
    return range == written || overlap(gpu::resolve(range, desc), gpu::resolve(written, desc));
  });
}

std::vector<bool> find_live_passes(const Declaration& declaration) {
  std::vector<Ranges> needed(declaration.resources.size());
  std::vector<bool> live(declaration.passes.size(), false);
  for (std::uint32_t p = declaration.passes.size(); p-- > 0;) {
    const DeclaredPass& pass = declaration.passes[p];
    const auto uses = declaration.uses_of(pass);
    bool alive = pass.keep;
    for (const DeclaredUse& use : uses) {
      const DeclaredResource& resource = declaration.resources[use.resource];
      alive = alive ||
              (use.writes && (resource.imported || any_overlap(needed[use.resource], use.range, resource.image_desc)));
    }
    live[p] = alive;
    if (!alive) continue;
    for (const DeclaredUse& use : uses) {
      Ranges& ranges = needed[use.resource];
      if (std::ranges::find(ranges, use.range) == ranges.end()) ranges.push_back(use.range);
    }
  }
  return live;
}

void add_usage(ResourceLife& life, const DeclaredUse& use, bool is_image) {
  gpu::for_each_access(use.accesses, [&](Access access) {
    if (is_image) {
      life.image_usage |= static_cast<std::uint32_t>(gpu::image_usage_of(access));
    } else {
      life.buffer_usage |= static_cast<std::uint32_t>(gpu::buffer_usage_of(access));
    }
  });
}

Plan place_barriers(const Declaration& declaration) {
  Plan plan;
  plan.lives.resize(declaration.resources.size());
  const std::vector<bool> live = find_live_passes(declaration);
  BarrierPlacer placer(declaration, plan);
  for (std::uint32_t p = 0; p < declaration.passes.size(); ++p) {
    if (!live[p]) continue;
    const auto time = static_cast<std::uint32_t>(plan.passes.size());
    plan.passes.push_back({.pass = p});
    placer.begin_pass(time);
    for (const DeclaredUse& use : declaration.uses_of(declaration.passes[p])) {
      ResourceLife& life = plan.lives[use.resource];
      if (life.first == kNone) life.first = time;
      life.last = time;
      add_usage(life, use, declaration.resources[use.resource].is_image);
      placer.use(use);
    }
  }
  placer.finish();
  return plan;
}

}  // namespace

Plan compile_plan(const Declaration& declaration) {
  Plan plan = place_barriers(declaration);
  const Status shared = share_memory(declaration, nullptr, plan);
  GLOAM_ASSERT(shared.ok(), "only a device can refuse a resource");
  return plan;
}

Result<Plan> compile_plan(const Declaration& declaration, const gpu::Device& device) {
  Plan plan = place_barriers(declaration);
  GLOAM_TRY(share_memory(declaration, &device, plan));
  return plan;
}

}  // namespace gloam::frame

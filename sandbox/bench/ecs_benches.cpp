// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <memory>
#include <optional>
#include <utility>

#include "sandbox/bench/benches.h"
#include "sandbox/bench/ecs_case.h"
#include "sandbox/bench/measure.h"

namespace gloam {
namespace bench {
namespace {

/// A case and what was measured of it so far: its two rows share the measurement of the world.
struct MeasuredCase {
  EcsCase ecs_case;
  std::optional<Timing> world;

  const Timing& world_timing() {
    if (!world) world = ecs_case.world();
    return *world;
  }
};

}  // namespace

void add_case(BenchRegistry& registry, EcsCase ecs_case) {
  const auto measured = std::make_shared<MeasuredCase>(MeasuredCase{.ecs_case = std::move(ecs_case), .world = {}});
  const std::string id = measured->ecs_case.id;
  registry.add({.id = id,
                .unit = "ns/entity",
                .bar = {},
                .better = Better::lower,
                .run = [measured](BenchContext&) -> Result<BenchValue> {
                  const Timing& world = measured->world_timing();
                  return per_item(world.ns, measured->ecs_case.entities, world.hash);
                }});
  registry.add({.id = id + "_over_bare",
                .unit = "ratio",
                .bar = {},
                .better = Better::lower,
                .run = [measured, id](BenchContext&) -> Result<BenchValue> {
                  const Timing& world = measured->world_timing();
                  const Timing bare = measured->ecs_case.bare();
                  if (world.hash != bare.hash)
                    return Error{ErrorKind::failed, id + ": the world and plain arrays computed different things"};
                  return ratio_of(world.ns, bare.ns, world.hash);
                }});
}

}  // namespace bench

void add_ecs_benches(BenchRegistry& registry) {
  bench::add_iteration_cases(registry);
  bench::add_change_cases(registry);
}

}  // namespace gloam

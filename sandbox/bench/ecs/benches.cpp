// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "sandbox/bench/ecs/case.h"
#include "sandbox/bench/harness/benches.h"
#include "sandbox/bench/harness/measure.h"

namespace gloam {
namespace bench {
namespace {

constexpr int kEcsRepetitions = 21;

struct Comparison {
  PairTimes times;  ///< a: the world
  std::uint64_t world_hash = 0;
  std::uint64_t bare_hash = 0;
};

using MakeSide = std::function<std::unique_ptr<Contender>()>;

Comparison compare_worlds(const MakeSide& make_world, const MakeSide& make_bare) {
  const auto world = make_world();
  const auto bare = make_bare();
  const auto side_of = [](Contender& contender) {
    return TimedCall{.prepare = [&] { contender.prepare(); }, .run = [&] { contender.run(); }};
  };
  Comparison comparison;
  comparison.times = time_pair_ns(kEcsRepetitions, side_of(*world), side_of(*bare));
  comparison.world_hash = world->hash();
  comparison.bare_hash = bare->hash();
  return comparison;
}

/// A comparison that several rows share. It is made at the first use.
class SharedComparison {
 public:
  SharedComparison(MakeSide world, MakeSide bare) : world_(std::move(world)), bare_(std::move(bare)) {}
  [[nodiscard]] const Comparison& get() {
    if (!comparison_) comparison_ = compare_worlds(world_, bare_);
    return *comparison_;
  }

 private:
  MakeSide world_;
  MakeSide bare_;
  std::optional<Comparison> comparison_;
};

void add_ecs_ratio(BenchRegistry& registry, const std::string& id, std::optional<double> bar,
                   const std::shared_ptr<SharedComparison>& shared) {
  registry.add({.id = id,
                .unit = "ratio",
                .bar = bar,
                .better = Better::lower,
                .run = [shared, id](BenchContext&) -> Result<BenchValue> {
                  const Comparison& c = shared->get();
                  if (c.world_hash != c.bare_hash)
                    return Error{ErrorKind::failed, id + ": the world and plain arrays computed different things"};
                  return ratio_of(c.times.a_ns, c.times.b_ns, c.world_hash);
                }});
}

}  // namespace

void add_case(BenchRegistry& registry, const EcsCase& ecs_case) {
  const auto shared = std::make_shared<SharedComparison>(ecs_case.world, ecs_case.bare);
  registry.add({.id = ecs_case.id,
                .unit = "ns/entity",
                .bar = ecs_case.bar_ns,
                .better = Better::lower,
                .run = [shared, entities = ecs_case.entities](BenchContext&) -> Result<BenchValue> {
                  const Comparison& c = shared->get();
                  return per_item(c.times.a_ns, entities, c.world_hash);
                }});
  add_ecs_ratio(registry, ecs_case.id + "_over_bare", ecs_case.bar_ratio, shared);
  if (!ecs_case.unchecked_bare) return;
  add_ecs_ratio(registry, ecs_case.id + "_over_unchecked_bare", {},
                std::make_shared<SharedComparison>(ecs_case.world, ecs_case.unchecked_bare));
}

}  // namespace bench

void add_ecs_benches(BenchRegistry& registry) {
  bench::add_iteration_cases(registry);
  bench::add_change_cases(registry);
}

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <memory>
#include <optional>
#include <utility>

#include "sandbox/bench/ecs/case.h"
#include "sandbox/bench/harness/benches.h"
#include "sandbox/bench/harness/measure.h"

namespace gloam {
namespace bench {
namespace {

constexpr int kRepetitions = 21;

struct Comparison {
  PairTimes times;  ///< a: the world
  std::uint64_t world_hash = 0;
  std::uint64_t bare_hash = 0;
};

/// A case and its comparison once it was made: its two rows share it.
class MeasuredCase {
 public:
  explicit MeasuredCase(EcsCase ecs_case) : case_(std::move(ecs_case)) {}

  [[nodiscard]] const EcsCase& ecs_case() const { return case_; }
  [[nodiscard]] const Comparison& comparison() {
    if (!comparison_) comparison_ = compare();
    return *comparison_;
  }

 private:
  [[nodiscard]] Comparison compare() const {
    const auto world = case_.world();
    const auto bare = case_.bare();
    Comparison comparison;
    comparison.times = time_pair_ns(kRepetitions, side_of(*world), side_of(*bare));
    comparison.world_hash = world->hash();
    comparison.bare_hash = bare->hash();
    return comparison;
  }
  static TimedSide side_of(Contender& contender) {
    return {.prepare = [&] { contender.prepare(); }, .run = [&] { contender.run(); }};
  }

  EcsCase case_;
  std::optional<Comparison> comparison_;
};

}  // namespace

void add_case(BenchRegistry& registry, EcsCase ecs_case) {
  const std::string id = ecs_case.id;
  const auto measured = std::make_shared<MeasuredCase>(std::move(ecs_case));
  registry.add({.id = id,
                .unit = "ns/entity",
                .bar = measured->ecs_case().bar_ns,
                .better = Better::lower,
                .run = [measured](BenchContext&) -> Result<BenchValue> {
                  const Comparison& c = measured->comparison();
                  return per_item(c.times.a_ns, measured->ecs_case().entities, c.world_hash);
                }});
  registry.add({.id = id + "_over_bare",
                .unit = "ratio",
                .bar = measured->ecs_case().bar_ratio,
                .better = Better::lower,
                .run = [measured, id](BenchContext&) -> Result<BenchValue> {
                  const Comparison& c = measured->comparison();
                  if (c.world_hash != c.bare_hash)
                    return Error{ErrorKind::failed, id + ": the world and plain arrays computed different things"};
                  return ratio_of(c.times.a_ns, c.times.b_ns, c.world_hash);
                }});
}

}  // namespace bench

void add_ecs_benches(BenchRegistry& registry) {
  bench::add_iteration_cases(registry);
  bench::add_change_cases(registry);
}

}  // namespace gloam

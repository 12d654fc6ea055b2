// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sandbox/bench/dof/case.h"
#include "sandbox/bench/harness/benches.h"
#include "sandbox/bench/harness/context.h"
#include "sandbox/bench/harness/gather_yardstick.h"
#include "sandbox/bench/harness/measure.h"
#include "sandbox/bench/harness/once.h"

// Time that depth of field adds to a frame, against the gather pass.

namespace gloam {
namespace {

constexpr int kDofFrameRounds = 15;
constexpr int kDofFrameWarmUp = 2;

struct DofCost {
  std::vector<double> passes_ns;  ///< all passes of the module
  std::vector<double> tiles_ns, prefilter_ns, blur_ns, compose_ns;
  std::vector<double> with_ns;  ///< GPU time of whole frames
  std::vector<double> without_ns;
  std::vector<double> gather_ns;
  std::uint64_t hash = 0;  ///< of the light with depth of field
  std::uint64_t without_hash = 0;
  std::uint64_t gather_hash = 0;

  void add(const FrameSample& with, const FrameSample& without, double gather) {
    const DofTimes times = dof_times(with);
    passes_ns.push_back(times.all_ns());
    tiles_ns.push_back(times.tiles_ns);
    prefilter_ns.push_back(times.prefilter_ns);
    blur_ns.push_back(times.blur_ns);
    compose_ns.push_back(times.compose_ns);
    with_ns.push_back(with.report.gpu_ms * kNsPerMs);
    without_ns.push_back(without.report.gpu_ms * kNsPerMs);
    gather_ns.push_back(gather);
  }
};

Result<FrameSample> draw_turned(DofFrames& frames, bool on, std::uint64_t& hash) {
  frames.turn(on);
  auto sample = frames.draw();
  if (!sample) return sample.error();
  const auto light = frames.linear();
  if (!light) return light.error();
  hash = hash_of_dof_light(*light);
  return sample;
}

Result<double> time_gathers(GatherYardstick& yardstick) {
  const auto start = std::chrono::steady_clock::now();
  GLOAM_TRY(yardstick.draw());
  return std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - start).count();
}

/// Frames with depth of field, frames without it and gather passes, in turn. Empty if no camera has a focus.
Result<DofCost> measure_dof_cost(BenchContext& context, Bokeh bokeh) {
  DofCost cost;
  auto frames = DofFrames::open(context, bokeh);
  if (!frames) return frames.error();
  if (*frames == nullptr) return cost;
  auto yardstick =
      GatherYardstick::create(*(*frames)->session().device, context.options().width, context.options().height);
  if (!yardstick) return yardstick.error();
  for (int i = -kDofFrameWarmUp; i < kDofFrameRounds; ++i) {
    const auto with = draw_turned(**frames, true, cost.hash);
    if (!with) return with.error();
    const auto without = draw_turned(**frames, false, cost.without_hash);
    if (!without) return without.error();
    const auto gather = time_gathers(**yardstick);
    if (!gather) return gather.error();
    if (i >= 0) cost.add(*with, *without, *gather);
  }
  const auto gathered = (*yardstick)->picture_hash();
  if (!gathered) return gathered.error();
  cost.gather_hash = *gathered;
  return cost;
}

/// GPU time of whole frames that depth of field adds.
std::vector<double> added_by_dof_ns(const DofCost& cost) {
  std::vector<double> added;
  for (std::size_t i = 0; i < cost.with_ns.size(); ++i) added.push_back(cost.with_ns[i] - cost.without_ns[i]);
  return added;
}

void add_dof_frame_rows(BenchRegistry& registry, Bokeh bokeh) {
  const auto shared = std::make_shared<Once<DofCost>>();
  const auto add = [&](const std::string& id, const char* unit, std::optional<double> bar, auto value) {
    BenchRow row{.id = id, .unit = unit, .bar = bar};
    row.run = [=](BenchContext& context) -> Result<BenchValue> {
      const auto cost = shared->get([&] { return measure_dof_cost(context, bokeh); });
      if (!cost) return cost.error();
      if ((*cost)->passes_ns.empty()) return skipped_row(kNoFocus);
      BenchValue result = value(**cost);
      result.scene = context.scene_or(kLensScene);
      return result;
    };
    registry.add(std::move(row));
  };
  using C = DofCost;
  const std::string prefix = std::string("dof.frame.") + bokeh_name(bokeh) + ".";
  add(bokeh == Bokeh::round ? "dof.frame_over_gathers" : "dof.frame_over_gathers.hexagonal", "ratio", 0.45,
      [](const C& c) { return ratio_of(c.passes_ns, c.gather_ns, hash_of_both(c.hash, c.gather_hash)); });
  add(prefix + "added_over_gathers", "ratio", std::nullopt,
      [](const C& c) { return ratio_of(added_by_dof_ns(c), c.gather_ns, hash_of_both(c.hash, c.gather_hash)); });
  add(prefix + "added_ms", "ms", std::nullopt,
      [](const C& c) { return per_item(added_by_dof_ns(c), kNsPerMs, hash_of_both(c.hash, c.without_hash)); });
  add(prefix + "without_ms", "ms", std::nullopt,
      [](const C& c) { return per_item(c.without_ns, kNsPerMs, c.without_hash); });
  add(prefix + "gather48_ms", "ms", std::nullopt,
      [](const C& c) { return per_item(c.gather_ns, kNsPerMs, c.gather_hash); });
  const auto add_passes = [&](const char* name, std::vector<double> C::*times) {
    add(prefix + name, "ms", std::nullopt, [times](const C& c) { return per_item(c.*times, kNsPerMs, c.hash); });
  };
  add_passes("passes_ms", &C::passes_ns);
  add_passes("tiles_ms", &C::tiles_ns);
  add_passes("prefilter_ms", &C::prefilter_ns);
  add_passes("blur_ms", &C::blur_ns);
  add_passes("compose_ms", &C::compose_ns);
}

}  // namespace

void add_dof_frame_benches(BenchRegistry& registry) {
  for (const Bokeh bokeh : {Bokeh::round, Bokeh::hexagonal}) add_dof_frame_rows(registry, bokeh);
}

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <array>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sandbox/bench/harness/benches.h"
#include "sandbox/bench/harness/context.h"
#include "sandbox/bench/harness/gather_yardstick.h"
#include "sandbox/bench/harness/measure.h"
#include "sandbox/bench/harness/once.h"
#include "sandbox/bench/reflections/case.h"

// Cost of the whole reflection chain in a frame, by steps, and against the gather pass.

namespace gloam {
namespace {

constexpr int kReflectionCostRounds = 15;
constexpr int kReflectionCostWarmUp = 3;
constexpr std::uint32_t kReflectionCostWidth = 640;  // of the frames that are compared with the gather pass
constexpr std::uint32_t kReflectionCostHeight = 360;

/// Steps of the chain, in its order. Each pass of the module in a settled frame belongs to one.
struct ChainStep {
  const char* name;                        ///< in the row's id
  std::array<const char*, 4> passes = {};  ///< beginnings of the names of its passes; unused ones are null
};
constexpr std::array<ChainStep, 7> kChainSteps = {
    {{"surfaces", {"reflection_start", "reflection_surfaces", "reflection_strong_tiles", "reflection_mirror_tiles"}},
     {"surroundings", {"reflection_surroundings"}},
     {"screen_space", {"reflection_screen_space"}},
     {"proxies", {"reflection_proxies"}},
     {"temporal", {"reflection_temporal"}},
     {"glossy", {"reflection_dilate", "reflection_blur"}},
     {"composite", {"reflection_composite"}}}};
constexpr std::size_t kFirstPostStep = 4;  // everything after the two searches

std::optional<std::size_t> reflection_step_of(std::string_view pass) {
  for (std::size_t step = 0; step < kChainSteps.size(); ++step)
    for (const char* beginning : kChainSteps[step].passes)
      if (beginning != nullptr && pass.starts_with(beginning)) return step;
  return std::nullopt;
}

struct ReflectionCost {
  std::vector<double> with_ns;  ///< GPU time of whole frames
  std::vector<double> without_ns;
  std::vector<double> gather_ns;
  std::array<std::vector<double>, kChainSteps.size()> step_ns;
  std::vector<double> chain_ns;     ///< all passes of the module
  std::vector<double> lighting_ns;  ///< what the passes of the module lighting take more with reflections
  std::uint64_t hash = 0;           ///< of the light with reflections
  std::uint64_t without_hash = 0;
  std::uint64_t gather_hash = 0;
  std::string scene;
};

Result<double> gather_ns(GatherYardstick& yardstick) {
  const auto start = std::chrono::steady_clock::now();
  GLOAM_TRY(yardstick.draw());
  return std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - start).count();
}

/// ErrorKind::failed if a pass of the module belongs to no step: the steps must sum to the chain.
Status add_steps(ReflectionCost& cost, const FrameSample& sample) {
  std::array<double, kChainSteps.size()> ms{};
  for (const PassTime& pass : sample.report.passes) {
    if (pass.module != "reflections") continue;
    const auto step = reflection_step_of(pass.name);
    if (!step) return Error{ErrorKind::failed, "pass " + pass.name + " belongs to no step of the reflection chain"};
    ms[*step] += pass.ms;
  }
  for (std::size_t step = 0; step < kChainSteps.size(); ++step) cost.step_ns[step].push_back(ms[step] * kNsPerMs);
  cost.chain_ns.push_back(reflection_ms(sample) * kNsPerMs);
  return {};
}

double reflected_lighting_ns(const FrameSample& sample) {
  double ms = 0.0;
  for (const PassTime& pass : sample.report.passes) ms += pass.module == "lighting" ? pass.ms : 0.0;
  return ms * kNsPerMs;
}

/// Frames with reflections, frames without them and gather passes, in turn.
Result<ReflectionCost> measure_reflection_cost(BenchContext& context) {
  ReflectionCost cost;
  cost.scene = courtyard_scene(context).value_or(context.scene_or(kWetStreet));
  auto session = context.open_builtin(cost.scene);
  if (!session) return session.error();
  auto yardstick = GatherYardstick::create(*(*session)->device, kReflectionCostWidth, kReflectionCostHeight);
  if (!yardstick) return yardstick.error();
  ReflectionFrames frames(**session, kReflectionCostWidth, kReflectionCostHeight);
  for (int i = -kReflectionCostWarmUp; i < kReflectionCostRounds; ++i) {
    const auto with = draw_in_mode(frames, "tiers", cost.hash);
    if (!with) return with.error();
    const auto without = draw_in_mode(frames, "off", cost.without_hash);
    if (!without) return without.error();
    const auto gather = gather_ns(**yardstick);
    if (!gather) return gather.error();
    if (i < 0) continue;
    GLOAM_TRY(add_steps(cost, *with));
    cost.lighting_ns.push_back(reflected_lighting_ns(*with) - reflected_lighting_ns(*without));
    cost.with_ns.push_back(with->report.gpu_ms * kNsPerMs);
    cost.without_ns.push_back(without->report.gpu_ms * kNsPerMs);
    cost.gather_ns.push_back(*gather);
  }
  const auto gathered = (*yardstick)->picture_hash();
  if (!gathered) return gathered.error();
  cost.gather_hash = *gathered;
  return cost;
}

/// GPU time of whole frames that reflections add.
std::vector<double> added_ns(const ReflectionCost& cost) {
  std::vector<double> added;
  for (std::size_t i = 0; i < cost.with_ns.size(); ++i) added.push_back(cost.with_ns[i] - cost.without_ns[i]);
  return added;
}

void add_reflection_frame_rows(BenchRegistry& registry) {
  const auto shared = std::make_shared<Once<ReflectionCost>>();
  const auto add = [&](const std::string& id, const char* unit, std::optional<double> bar, auto value) {
    BenchRow row;
    row.id = "reflections." + id;
    row.unit = unit;
    row.bar = bar;
    row.run = [=](BenchContext& context) -> Result<BenchValue> {
      const auto cost = shared->get([&] { return measure_reflection_cost(context); });
      if (!cost) return cost.error();
      BenchValue result = value(**cost);
      result.scene = (*cost)->scene;
      return result;
    };
    registry.add(std::move(row));
  };
  using C = ReflectionCost;
  const auto hash = [](const C& c) { return hash_of_both(c.hash, c.without_hash); };
  // The goal is 0.4.
  add("frame_over_gathers", "ratio", 0.6,
      [=](const C& c) { return ratio_of(added_ns(c), c.gather_ns, hash_of_both(hash(c), c.gather_hash)); });
  add("frame.added_ms", "ms", std::nullopt, [=](const C& c) { return per_item(added_ns(c), kNsPerMs, hash(c)); });
  add("frame.without_ms", "ms", std::nullopt,
      [](const C& c) { return per_item(c.without_ns, kNsPerMs, c.without_hash); });
  add("frame.gather48_ms", "ms", std::nullopt,
      [](const C& c) { return per_item(c.gather_ns, kNsPerMs, c.gather_hash); });
  add("frame.chain_ms", "ms", std::nullopt, [](const C& c) { return per_item(c.chain_ns, kNsPerMs, c.hash); });
  add("frame.lighting_growth_ms", "ms", std::nullopt,
      [=](const C& c) { return per_item(c.lighting_ns, kNsPerMs, hash(c)); });
  for (std::size_t step = 0; step < kChainSteps.size(); ++step)
    add(std::string("frame.") + kChainSteps[step].name + "_ms", "ms", std::nullopt,
        [step](const C& c) { return per_item(c.step_ns[step], kNsPerMs, c.hash); });
  add("frame.post_processing_ms", "ms", std::nullopt, [](const C& c) {
    std::vector<double> ns(c.chain_ns.size(), 0.0);
    for (std::size_t step = kFirstPostStep; step < kChainSteps.size(); ++step)
      for (std::size_t i = 0; i < ns.size(); ++i) ns[i] += c.step_ns[step][i];
    return per_item(ns, kNsPerMs, c.hash);
  });
}

}  // namespace

void add_reflection_cost_benches(BenchRegistry& registry) { add_reflection_frame_rows(registry); }

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sandbox/bench/grass/case.h"
#include "sandbox/bench/grass/tips.h"
#include "sandbox/bench/harness/benches.h"
#include "sandbox/bench/harness/context.h"
#include "sandbox/bench/harness/measure.h"
#include "sandbox/bench/harness/once.h"

// Time and error of the simulation by the share of simulated blades and by the number of iterations. All blades in view
// are live, and wind alone moves them.

namespace gloam {
namespace {

constexpr const char* kSimulationCamera = "near";
constexpr std::uint32_t kSimulationWidth = 160;  // the simulation does not depend on the size
constexpr std::uint32_t kSimulationHeight = 90;
constexpr int kSimulationRounds = 7;
constexpr int kWindFrames = 45;               // before tips are compared: 3 s
constexpr double kWindFrame_s = 8.0 / 120.0;  // the longest frame of which no time is dropped
constexpr std::size_t kTips = 8192;           // of all live blades
constexpr std::size_t kReferenceTips = 256;   // compared with the costly reference
constexpr double kMostMasterError_mm = 1.0;   // 99th percentile, of single precision
constexpr std::uint32_t kDefaultIterations = 3;

constexpr std::array<const char*, 5> kRatios = {"1:1", "1:2", "1:4", "1:8", "1:16"};
constexpr std::size_t kFull = 0;
constexpr std::size_t kDefaultRatio = 2;
constexpr std::uint32_t kMostIterations = 8;
constexpr TipSimulation kReference = {.iterations = 64, .step_parts = 8};

struct SimulationRun {
  std::vector<double> ns;  ///< of the pass
  ErrorStatistics error_mm;
  double bend_mm = 0.0;    ///< mean distance of the drawn tips from rest
  std::uint64_t hash = 0;  ///< of the drawn tips
};

Result<std::unique_ptr<GrassCase>> open_case(BenchContext& context) {
  auto grass = GrassCase::open(context, kSimulationCamera, kSimulationWidth, kSimulationHeight);
  if (!grass) return grass.error();
  (*grass)->remove_colliders();
  GLOAM_TRY((*grass)->set("grass.lod_pixels", "0"));
  GLOAM_TRY((*grass)->set("grass.far_steps", "one"));
  return grass;
}

/// A grass that has moved in the wind, and the frames' constants.
struct Windy {
  GrassReading reading;
  std::vector<shaders::GrassSteps> frames;
};

Result<Windy> draw_wind(GrassCase& grass) {
  grass.restart();
  Windy windy;
  for (int i = 0; i + 1 < kWindFrames; ++i) {
    if (const auto sample = grass.draw(kWindFrame_s); !sample) return sample.error();
    windy.frames.push_back(grass.probe().steps());
  }
  auto reading = grass.draw_and_read(kWindFrame_s);
  if (!reading) return reading.error();
  windy.frames.push_back(grass.probe().steps());
  windy.reading = std::move(reading).value();
  return windy;
}

Status measure_tips(GrassCase& grass, SimulationRun& run) {
  const auto windy = draw_wind(grass);
  if (!windy) return windy.error();
  const GrassField& field = grass.session().world.resource<GrassField>();
  JobExecutor& jobs = *grass.session().executor;
  const std::vector<DrawnTip> drawn = drawn_tips(field, windy->reading, TipChoice::all, kTips);
  const std::vector<dvec3> simulated = simulated_tips(drawn, windy->frames, {.iterations = kDefaultIterations}, jobs);
  run.error_mm = tip_error_mm(simulated, tips_of(drawn));
  run.bend_mm = tip_error_mm(rest_tips(drawn), tips_of(drawn)).mean;
  run.hash = hash_of_tips(drawn);
  // A master differs from the reference by its precision only.
  std::vector<dvec3> masters, simulated_masters;
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    if (!drawn[i].master) continue;
    masters.push_back(drawn[i].tip);
    simulated_masters.push_back(simulated[i]);
  }
  const double error_mm = tip_error_mm(simulated_masters, masters).p99;
  if (error_mm <= kMostMasterError_mm) return {};
  return Error{ErrorKind::failed, "grass.masters: the tips of masters differ by " + std::to_string(error_mm) +
                                      " mm from their simulation in double"};
}

using MasterRuns = std::array<SimulationRun, kRatios.size()>;

Result<MasterRuns> measure_masters(BenchContext& context) {
  const auto grass = open_case(context);
  if (!grass) return grass.error();
  MasterRuns runs;
  for (int round = -1; round < kSimulationRounds; ++round) {
    for (std::size_t i = 0; i < kRatios.size(); ++i) {
      GLOAM_TRY((*grass)->set("grass.masters", kRatios[i]));
      if (const auto regrown = (*grass)->draw(kGrassFrame_s); !regrown) return regrown.error();
      const auto sample = (*grass)->draw(kGrassFrame_s);
      if (!sample) return sample.error();
      if (round >= 0) runs[i].ns.push_back(grass_times(*sample).simulation_ns);
    }
  }
  for (std::size_t i = 0; i < kRatios.size(); ++i) {
    if (i == kFull) continue;
    GLOAM_TRY((*grass)->set("grass.masters", kRatios[i]));
    GLOAM_TRY(measure_tips(**grass, runs[i]));
  }
  return runs;
}

struct IterationRuns {
  std::array<SimulationRun, kMostIterations> runs;  ///< of 1, 2, … iterations
  double reference_bend_mm = 0.0;                   ///< SimulationRun::bend_mm of the reference
};

Result<IterationRuns> measure_iterations(BenchContext& context) {
  const auto grass = open_case(context);
  if (!grass) return grass.error();
  const auto set = [&](std::size_t i) { return (*grass)->set("grass.iterations", std::to_string(i + 1)); };
  IterationRuns all;
  auto& runs = all.runs;
  for (int round = -1; round < kSimulationRounds; ++round) {
    for (std::size_t i = 0; i < kMostIterations; ++i) {
      GLOAM_TRY(set(i));
      const auto sample = (*grass)->draw(kGrassFrame_s);
      if (!sample) return sample.error();
      if (round >= 0) runs[i].ns.push_back(grass_times(*sample).simulation_ns);
    }
  }
  std::vector<dvec3> expected;  // restarted runs see the same wind
  for (std::size_t i = 0; i < kMostIterations; ++i) {
    GLOAM_TRY(set(i));
    const auto windy = draw_wind(**grass);
    if (!windy) return windy.error();
    const GrassField& field = (*grass)->session().world.resource<GrassField>();
    const std::vector<DrawnTip> drawn = drawn_tips(field, windy->reading, TipChoice::masters, kReferenceTips);
    if (expected.empty()) expected = simulated_tips(drawn, windy->frames, kReference, *(*grass)->session().executor);
    all.reference_bend_mm = tip_error_mm(rest_tips(drawn), expected).mean;
    runs[i].error_mm = tip_error_mm(expected, tips_of(drawn));
    runs[i].bend_mm = tip_error_mm(rest_tips(drawn), tips_of(drawn)).mean;
    runs[i].hash = hash_of_tips(drawn);
  }
  return all;
}

/// Rows of the error and the time of one run. find: the run among those that `get` returns.
template <class Get>
void add_run_rows(BenchRegistry& registry, const std::string& id, bool with_error, Get get) {
  const auto add = [&](const char* what, const char* unit, auto value) {
    BenchRow row;
    row.id = id + what;
    row.unit = unit;
    row.run = [get, value](BenchContext& context) -> Result<BenchValue> {
      const auto run = get(context);
      if (!run) return run.error();
      BenchValue result = value(**run);
      result.scene = kMeadow;
      return result;
    };
    registry.add(std::move(row));
  };
  add(".ms", "ms", [](const SimulationRun& run) { return per_item(run.ns, kNsPerMs, run.hash); });
  if (!with_error) return;
  add(".tip_error_mean_mm", "mm", [](const SimulationRun& run) { return single_value(run.error_mm.mean, run.hash); });
  add(".tip_error_p99_mm", "mm", [](const SimulationRun& run) { return single_value(run.error_mm.p99, run.hash); });
  add(".tip_bend_mean_mm", "mm", [](const SimulationRun& run) { return single_value(run.bend_mm, run.hash); });
}

void add_master_rows(BenchRegistry& registry) {
  const auto shared = std::make_shared<Once<MasterRuns>>();
  BenchRow over;
  over.id = "grass.masters_1_4_over_full";
  over.unit = "ratio";
  over.bar = 0.30;
  over.run = [shared](BenchContext& context) -> Result<BenchValue> {
    const auto runs = shared->get([&] { return measure_masters(context); });
    if (!runs) return runs.error();
    const SimulationRun& slaves = (**runs)[kDefaultRatio];
    BenchValue value = ratio_of(slaves.ns, (**runs)[kFull].ns, slaves.hash);
    value.scene = kMeadow;
    return value;
  };
  registry.add(std::move(over));
  for (std::size_t i = 0; i < kRatios.size(); ++i) {
    std::string ratio = kRatios[i];
    ratio[1] = '_';
    add_run_rows(registry, "grass.masters." + ratio, i != kFull,
                 [shared, i](BenchContext& context) -> Result<const SimulationRun*> {
                   const auto runs = shared->get([&] { return measure_masters(context); });
                   if (!runs) return runs.error();
                   return &(**runs)[i];
                 });
  }
}

void add_iteration_rows(BenchRegistry& registry) {
  const auto shared = std::make_shared<Once<IterationRuns>>();
  BenchRow reference;
  reference.id = "grass.iterations.reference.tip_bend_mean_mm";
  reference.unit = "mm";
  reference.run = [shared](BenchContext& context) -> Result<BenchValue> {
    const auto runs = shared->get([&] { return measure_iterations(context); });
    if (!runs) return runs.error();
    BenchValue value = single_value((*runs)->reference_bend_mm, hash_of_number((*runs)->reference_bend_mm));
    value.scene = kMeadow;
    return value;
  };
  registry.add(std::move(reference));
  for (std::size_t i = 0; i < kMostIterations; ++i) {
    add_run_rows(registry, "grass.iterations." + std::to_string(i + 1), true,
                 [shared, i](BenchContext& context) -> Result<const SimulationRun*> {
                   const auto runs = shared->get([&] { return measure_iterations(context); });
                   if (!runs) return runs.error();
                   return &(*runs)->runs[i];
                 });
  }
}

}  // namespace

void add_grass_simulation_benches(BenchRegistry& registry) {
  add_master_rows(registry);
  add_iteration_rows(registry);
}

}  // namespace gloam

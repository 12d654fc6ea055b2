// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "engine/render/governor/governor.h"
#include "sandbox/bench/governor/case.h"
#include "sandbox/bench/harness/benches.h"
#include "sandbox/bench/harness/measure.h"
#include "sandbox/bench/harness/once.h"
#include "sandbox/output/file_io.h"
#include "sandbox/session/loading/scene_loading.h"

// Frames under time budgets, by a ledger of four knobs: frame times over the budget, changes, and errors over the best
// of all combinations. With --budget, only that budget, without combinations. With --out, the frames of all runs.

namespace gloam {
namespace {

constexpr std::array<const char*, 3> kGovernedScenes = {"builtin:wet_street", "builtin:lanterns", "builtin:closeups"};
constexpr const char* kUsersScene = "scene";  // the rows of --scene

using SharedScene = std::shared_ptr<Once<GovernedScene>>;
using WorstOf = std::function<double(const GovernedScene&, const GovernedRun&)>;

Result<GovernedScene> measure_and_write(BenchContext& context, const std::string& scene) {
  const Options& options = context.options();
  std::vector<EffectBudget> budgets = options.effect_budgets;
  if (options.budget_ms) budgets.push_back({.effect = {}, .ms = *options.budget_ms});
  if (budgets.size() > 1) return Error{ErrorKind::usage, "bench governor takes one --budget"};
  auto measured = budgets.empty() ? measure_governed_scene(context, scene)
                                  : measure_governed_budget(context, scene, budgets.front());
  if (!measured || options.out.empty()) return measured;
  const std::string path = options.out + "/" + scene_stem(scene) + ".csv";
  GLOAM_TRY(make_folder_of(path));
  GLOAM_TRY(write_file(path, trace_csv(*measured)));
  GLOAM_TRY(write_file(options.out + "/" + scene_stem(scene) + ".settings.csv", settings_csv(*measured)));
  return measured;
}

struct GovernedRow {
  const char* id;
  const char* unit;
  std::optional<double> bar;
  const char* run;  ///< name of the runs that count; empty: standing and path
  WorstOf figure;
};

const std::array<GovernedRow, 7> kGovernedRows = {{
    {"standing", "of the budget", 1.1, "standing",
     [](const auto&, const auto& run) { return figures_of(run).percentile_90; }},
    {"path", "of the budget", 1.1, "path", [](const auto&, const auto& run) { return figures_of(run).percentile_90; }},
    {"longest", "of the budget", 2.0, "", [](const auto&, const auto& run) { return figures_of(run).longest; }},
    {"changes_at_rest", "1/s", 1.0, "standing",
     [](const auto&, const auto& run) { return figures_of(run).changes_a_second; }},
    {"settled", "s", 2.0, "load", [](const auto&, const auto& run) { return figures_of(run).settled_s; }},
    {"error_over_best", "ratio", 1.05, "standing",
     [](const auto& scene, const auto& run) { return error_over_best(scene, run); }},
    // The governor enters a setting only if it is predicted to leave 10 % to spare: against the best that does.
    {"error_over_best_to_spare", "ratio", std::nullopt, "standing",
     [](const auto& scene, const auto& run) { return error_over_best(scene, run, Governor::kFit); }},
}};

/// The worst run, with the least and the most of all as its spread.
Result<BenchValue> worst_run(BenchContext& context, const std::string& scene, const SharedScene& shared,
                             const GovernedRow& row) {
  const auto measured = shared->get([&] { return measure_and_write(context, scene); });
  if (!measured) return measured.error();
  const GovernedScene& governed = **measured;
  if (std::string_view(row.id).starts_with("error_over_best") && governed.tried.empty())
    return skipped_row("--budget tries no combinations");
  std::vector<double> values;
  for (const GovernedRun& run : governed.runs) {
    const bool counts = *row.run == '\0' ? run.name != "load" : run.name == row.run;
    if (counts) values.push_back(row.figure(governed, run));
  }
  if (values.empty()) return skipped_row("one camera gives no path");
  BenchValue value = single_value(std::ranges::max(values), hash_of_number(static_cast<double>(governed.front.size())));
  value.p10 = std::ranges::min(values);
  value.p90 = std::ranges::max(values);
  value.scene = scene;
  return value;
}

void add_governed_scene(BenchRegistry& registry, const std::string& name, const char* scene) {
  const auto shared = std::make_shared<Once<GovernedScene>>();
  for (const GovernedRow& row : kGovernedRows) {
    const auto run = [=, &row](BenchContext& context) -> Result<BenchValue> {
      if (scene != nullptr && !context.options().scene_is_default) return skipped_row("--scene names another scene");
      if (scene != nullptr) return worst_run(context, scene, shared, row);
      if (context.options().scene_is_default) return skipped_row("for the scene of --scene");
      return worst_run(context, context.options().scene, shared, row);
    };
    registry.add({.id = "governor." + name + "." + row.id,
                  .unit = row.unit,
                  .bar = row.bar,
                  .better = Better::lower,
                  .run = run});
  }
}

}  // namespace

void add_governor_benches(BenchRegistry& registry) {
  for (const char* scene : kGovernedScenes)
    add_governed_scene(registry, std::string(scene).substr(std::string_view("builtin:").size()), scene);
  add_governed_scene(registry, kUsersScene, nullptr);
}

}  // namespace gloam

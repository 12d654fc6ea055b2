// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/bench/governor/case.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <memory>
#include <utility>

#include "engine/core/system/process.h"
#include "engine/scene/systems.h"
#include "modules/accuracy/module.h"
#include "sandbox/bench/harness/camera_path.h"
#include "sandbox/output/identity.h"
#include "sandbox/session/drawing/enlarged.h"
#include "sandbox/session/drawing/session_budget.h"
#include "sandbox/session/drawing/session_costs.h"
#include "sandbox/session/loading/kept_ledger.h"
#include "sandbox/session/loading/ledger_header.h"
#include "sandbox/session/program_knobs.h"

namespace gloam {
namespace {

namespace fs = std::filesystem;

constexpr std::uint32_t kFrontPoints = 24;
constexpr double kLedgerMinutes = 2.0;
constexpr double kSecondsATry = 0.3;
constexpr double kRunSeconds = 8.0;
constexpr double kLoadAt = 0.5;  // share of the run before the step of load
constexpr double kLoad = 1.6;    // factor of the step
constexpr std::size_t kPathSteps = 10000;

/// Removes itself at its end.
struct ScratchFolder {
  std::string path = (fs::temp_directory_path() / ("gloam-governor-" + program_hash() + "-" + host_name())).string();
  ~ScratchFolder() {
    std::error_code fault;
    fs::remove_all(path, fault);
  }
};

Result<Ledger> measure_ledger(Session& session, const Options& options, SessionCosts& costs) {
  if (!options.ledger.empty()) {
    auto found = find_own_ledger(session, options, null_log());
    if (!found) return found.error();
    return std::move((**found).ledger);
  }
  const ScratchFolder folder;
  CostRequest request = {.header = ledger_header(session, options), .points = kFrontPoints, .folder = folder.path};
  request.header.frames = kQuickFrames;
  request.header.samples = kQuickSamples;
  request.header.quick = true;
  request.header.seconds = 60.0 * kLedgerMinutes;
  for (const std::string_view knob : kTriedKnobs) request.knobs.emplace_back(knob);
  CostProgress progress;
  return measure_costs(request, costs, progress);
}

/// All combinations of the tried knobs' values in the ledger.
std::vector<std::vector<KnobOverride>> combinations(const KnobRegistry& knobs) {
  std::vector<std::vector<KnobOverride>> all = {{}};
  for (const std::string_view name : kTriedKnobs) {
    std::vector<std::vector<KnobOverride>> longer;
    for (const auto& begun : all)
      for (const std::string& value : ledger_values(*knobs.find(name))) {
        longer.push_back(begun);
        longer.back().push_back({std::string(name), value});
      }
    all = std::move(longer);
  }
  return all;
}

/// Sets every knob that is judged to its exact value during its lifetime.
class ExactKnobs {
 public:
  explicit ExactKnobs(KnobRegistry& knobs) : knobs_(knobs), users_(knobs) {
    for (const Knob& knob : knobs.knobs()) {
      if (knob.is_look || knob.same_picture || knob.exact.empty()) continue;
      if (knobs.text(knob) == knob.exact) continue;
      const Status set = knobs.set(knob.name, knob.exact);
      if (set.ok()) back_.push_back({knob.name, users_.text(*users_.find(knob.name))});
    }
  }
  ~ExactKnobs() {
    for (const KnobOverride& knob : back_) static_cast<void>(knobs_.set(knob.name, knob.value));
  }
  ExactKnobs(const ExactKnobs&) = delete;
  ExactKnobs& operator=(const ExactKnobs&) = delete;
  /// What gives the knobs their values back.
  [[nodiscard]] const std::vector<KnobOverride>& back() const { return back_; }

 private:
  KnobRegistry& knobs_;
  KnobRegistry users_;
  std::vector<KnobOverride> back_;
};

Result<std::vector<TriedSetting>> try_combinations(Session& session, const Options& options, SessionCosts& costs) {
  const ExactKnobs exact(session.renderer->knobs());
  ShortLedgerRequest request = {.header = ledger_header(session, options),
                                .settings = combinations(session.renderer->knobs())};
  request.seconds = kSecondsATry * static_cast<double>(request.settings.size()) + 60.0;  // and the exact frames
  for (std::vector<KnobOverride>& settings : request.settings)
    for (const KnobOverride& knob : exact.back())
      if (std::ranges::find(kTriedKnobs, knob.name) == kTriedKnobs.end()) settings.push_back(knob);
  auto ledger = measure_short_ledger(request, costs);
  if (!ledger) return ledger.error();
  std::vector<TriedSetting> tried;
  for (const LedgerPoint& point : ledger->points)
    if (!point.measured.is_default) {
      const FrontPoint on_the_wall = front_points({.points = {point}}).front();
      tried.push_back({on_the_wall.ms, on_the_wall.error});
    }
  return tried;
}

/// The points that no other one beats, the fastest first.
std::vector<FrontPoint> sorted_front(std::vector<FrontPoint> points) {
  std::ranges::stable_sort(points, {}, &FrontPoint::ms);
  std::vector<FrontPoint> front;
  for (FrontPoint& point : points)
    if (front.empty() || point.error < front.back().error) front.push_back(std::move(point));
  return front;
}

class GovernedSession {
 public:
  GovernedSession(Session& session, const Options& options)
      : session_(session), options_(options), keys_(path_through_cameras(session.world, session.info)) {}

  [[nodiscard]] bool has_path() const { return keys_.size() > 1; }

  /// Frames with the knobs as they are: their median time on the wall.
  Result<double> median_ms(std::size_t frames) {
    std::vector<double> times;
    for (std::size_t i = 0; i < frames; ++i) {
      const auto drawn = draw(i, 0);
      if (!drawn) return drawn.error();
      if (i >= frames / 4) times.push_back(drawn->wall_ms());
    }
    std::ranges::sort(times);
    return times[times.size() / 2];
  }

  Result<GovernedRun> run(const GovernedScene& scene, double budget_ms, const std::string& name) {
    Renderer& renderer = *session_.renderer;
    GovernedRun run = {.budget_ms = budget_ms, .name = name};
    GLOAM_TRY(renderer.set_budget({.effect = scene.effect, .ms = budget_ms, .front = scene.front}));
    for (double share = 0.0; share < 1.0;) {
      const std::size_t point = renderer.budget(scene.effect)->point;
      const auto place = static_cast<std::size_t>(share * kPathSteps);
      const auto drawn = draw(run.frames.size(), name == "path" ? place : 0);
      if (!drawn) return drawn.error();
      if (name == "load" && run.step_at == 0 && share >= kLoadAt) run.step_at = run.frames.size();
      const double load = run.step_at > 0 ? kLoad : 1.0;
      const double wall_ms = load * drawn->wall_ms();
      const double ms = scene.effect.empty() ? wall_ms : load * effect_ms(drawn->report, scene.effect);
      share += wall_ms * 1e-3 / kRunSeconds;
      run.frames.push_back({.ms = ms, .wall_ms = wall_ms, .point = point, .error = scene.front[point].error});
      renderer.add_frame_time({.effect = scene.effect, .ms = ms});
    }
    renderer.clear_budget(scene.effect);
    return run;
  }

 private:
  /// place: 1…kPathSteps on the path through the cameras; 0: at the first camera.
  Result<FrameSample> draw(std::size_t frame, std::size_t place) {
    session_.set_clock(options_.time_s + static_cast<double>(frame) * options_.dt_s, options_.dt_s);
    const double scale = view_scale(session_.renderer->knobs());
    ViewRequest request = {.settings = session_.view_settings(scaled_size(options_.width, scale),
                                                              scaled_size(options_.height, scale), "none"),
                           .target = {}};
    if (place > 0) {
      request.settings.follow_camera = false;
      request.settings.world_from_camera = path_pose(keys_, place, kPathSteps);
    }
    return session_.render_frame(request);
  }

  Session& session_;
  const Options& options_;
  std::vector<PathKey> keys_;
};

/// Sets the tried knobs to a point of the front and draws.
Result<double> point_ms(Session& session, GovernedSession& governed, const FrontPoint& point) {
  KnobRegistry& knobs = session.renderer->knobs();
  for (const std::string_view name : kTriedKnobs) knobs.set_number(*knobs.find(name), knobs.find(name)->default_number);
  for (const KnobOverride& setting : point.settings) GLOAM_TRY(knobs.set(setting.name, setting.value));
  return governed.median_ms(24);
}

Status run_budgets(Session& session, const Options& options, std::span<const double> budgets, GovernedScene& scene) {
  GovernedSession governed(session, options);
  const KnobRegistry users = session.renderer->knobs();
  for (const double budget : budgets) {
    for (const char* const name : {"standing", "path", "load"}) {
      if (name == std::string_view("path") && !governed.has_path()) continue;
      if (name == std::string_view("load") && budget != budgets[budgets.size() / 2]) continue;
      auto run = governed.run(scene, budget, name);
      if (!run) return run.error();
      scene.runs.push_back(std::move(run).value());
    }
  }
  session.renderer->knobs().take_values(users);
  return {};
}

/// Budgets between the times of the fastest and the most exact point that is no slower than the user's settings, with
/// 10 % to spare at both ends.
Result<std::vector<double>> budgets_of(Session& session, const Options& options, const GovernedScene& scene) {
  GovernedSession governed(session, options);
  const KnobRegistry users = session.renderer->knobs();
  const auto low = point_ms(session, governed, scene.front.front());
  const auto high = low ? point_ms(session, governed, scene.front.back()) : low;
  session.renderer->knobs().take_values(users);
  if (!high) return high.error();
  const double first = *low / 0.8, last = std::max(*high / 0.8, first * 1.05);
  std::vector<double> budgets;
  for (std::size_t i = 0; i < kBudgets; ++i)
    budgets.push_back(first * std::pow(last / first, static_cast<double>(i) / (kBudgets - 1)));
  return budgets;
}

struct OpenedScene {
  std::unique_ptr<Session> session;
  Options options;
  GovernedScene scene;
};

/// Opens the scene and measures its front. effect: of GovernedScene.
Status open_governed(BenchContext& context, const std::string& scene, const std::string& effect, OpenedScene& opened) {
  auto session = context.open_builtin(scene);
  if (!session) return session.error();
  opened.session = std::move(session).value();
  opened.options = context.options();
  opened.options.scene = scene;
  opened.options.camera.clear();
  opened.options.out.clear();
  if (!opened.options.size_given) {
    opened.options.width = kQuickWidth;
    opened.options.height = kQuickHeight;
  }
  opened.scene.scene = scene;
  opened.scene.effect = effect;
  SessionCosts costs(*opened.session, opened.options);
  auto ledger = measure_ledger(*opened.session, opened.options, costs);
  if (!ledger) return ledger.error();
  if (!effect.empty()) {
    opened.scene.front = sorted_front(effect_points(*ledger, effect, opened.session->renderer->knobs()));
    if (!opened.scene.front.empty()) return {};
    return Error{ErrorKind::usage,
                 "--budget: none of the knobs that bench governor tries changes the time of " + effect};
  }
  std::vector<FrontPoint> points;
  for (const LedgerPoint& point : ledger->points)  // the exact setting takes many times as long as all others
    if (!point.is_exact) points.push_back(front_points({.points = {point}}).front());
  opened.scene.front = sorted_front(std::move(points));
  return {};
}

}  // namespace

Result<GovernedScene> measure_governed_scene(BenchContext& context, const std::string& scene) {
  OpenedScene opened;
  GLOAM_TRY(open_governed(context, scene, {}, opened));
  SessionCosts costs(*opened.session, opened.options);
  auto tried = try_combinations(*opened.session, opened.options, costs);
  if (!tried) return tried.error();
  opened.scene.tried = std::move(tried).value();
  const auto budgets = budgets_of(*opened.session, opened.options, opened.scene);
  if (!budgets) return budgets.error();
  GLOAM_TRY(run_budgets(*opened.session, opened.options, *budgets, opened.scene));
  return std::move(opened.scene);
}

Result<GovernedScene> measure_governed_budget(BenchContext& context, const std::string& scene,
                                              const EffectBudget& budget) {
  OpenedScene opened;
  GLOAM_TRY(open_governed(context, scene, budget.effect, opened));
  GLOAM_TRY(run_budgets(*opened.session, opened.options, {&budget.ms, 1}, opened.scene));
  return std::move(opened.scene);
}

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <numeric>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sandbox/bench/harness/benches.h"
#include "sandbox/bench/harness/context.h"
#include "sandbox/bench/harness/measure.h"
#include "sandbox/bench/harness/once.h"
#include "sandbox/bench/reflections/case.h"
#include "sandbox/bench/shadows/case.h"
#include "sandbox/session/results/summary.h"

// Reflection passes over the views of a walk: the slowest view, and what knobs of the paper cost and change.

namespace gloam {
namespace {

constexpr std::size_t kViews = 200;
constexpr int kWorstViewRounds = 5;
constexpr int kMeanViewRounds = 2;  // enough for sums over all views
constexpr std::uint32_t kViewWidth = 640;
constexpr std::uint32_t kViewHeight = 360;

/// The walk drawn with one value of a knob.
struct WalkValue {
  const char* knob;
  const char* value;
  const char* pass;  ///< that is timed; empty: all of the module
};

struct Views {
  std::vector<double> ms;  ///< of each view's fastest frame
  std::uint64_t hash = 0;
};

/// The walk with two values.
struct TwoWalks {
  std::array<Views, 2> views;
  std::vector<double> differing;  ///< share of each view's pixels that are not equal to the bit
};

double differing_share(const LinearPicture& a, const LinearPicture& b) {
  std::size_t pixels = 0;
  for (std::size_t p = 0; p < b.rgba.size(); p += 4)
    pixels += a.rgba[p] != b.rgba[p] || a.rgba[p + 1] != b.rgba[p + 1] || a.rgba[p + 2] != b.rgba[p + 2] ? 1 : 0;
  return static_cast<double>(pixels) / (static_cast<double>(b.width) * b.height);
}

/// Draws all views in several rounds and takes each one's fastest frame: other work on the machine only slows frames,
/// and the worst of 200 views would be the one that it met. Shadows are off: they change no reflection pass.
Result<TwoWalks> measure_views(BenchContext& context, const std::array<WalkValue, 2>& values, int rounds) {
  auto session = context.open_builtin(context.scene_or(kWetStreet));
  if (!session) return session.error();
  ReflectionFrames frames(**session, kViewWidth, kViewHeight);
  GLOAM_TRY(frames.set("shadows.mode", "off"));
  const std::vector<dmat4> poses = recorded_walk(**session, context.scene_or(kWetStreet), kViews, true);
  TwoWalks walks;
  for (Views& one : walks.views) one.ms.assign(poses.size(), 1e9);
  for (const WalkValue& value : values) {  // uploads the captured images and makes the pipelines
    GLOAM_TRY(frames.set(value.knob, value.value));
    if (const auto first = frames.draw(); !first) return first.error();
  }
  for (int round = 0; round < rounds; ++round)
    for (std::size_t i = 0; i < poses.size(); ++i) {
      frames.look_from(poses[i]);
      std::array<LinearPicture, 2> pictures;
      for (std::size_t k = 0; k < values.size(); ++k) {
        Views& views = walks.views[k];
        GLOAM_TRY(frames.set(values[k].knob, values[k].value));
        const auto sample = frames.draw();
        if (!sample) return sample.error();
        const std::string_view pass = values[k].pass;
        views.ms[i] = std::min(views.ms[i], pass.empty() ? reflection_ms(*sample) : pass_ms(*sample, pass));
        if (round > 0) continue;
        auto light = frames.linear();
        if (!light) return light.error();
        pictures[k] = std::move(light).value();
        views.hash = hash_of_both(views.hash, hash_of_light(pictures[k]));
      }
      if (round == 0) walks.differing.push_back(differing_share(pictures[0], pictures[1]));
    }
  return walks;
}

double worst_ms(const Views& views) { return *std::ranges::max_element(views.ms); }
double median_ms(const Views& views) { return summarize(views.ms).median; }
double worst_over_median(const Views& views) { return worst_ms(views) / std::max(median_ms(views), 1e-9); }

/// Sum of a over sum of b.
double time_ratio(const Views& a, const Views& b) {
  double first = 0.0, second = 0.0;
  for (const double ms : a.ms) first += ms;
  for (const double ms : b.ms) second += ms;
  return second > 0.0 ? first / second : 0.0;
}

/// Adds a row of a shared walk. value: of both values' views.
template <class Value>
void add_walk_row(BenchRegistry& registry, const std::shared_ptr<Once<TwoWalks>>& shared,
                  const std::array<WalkValue, 2>& values, int rounds, const std::string& id, const char* unit,
                  std::optional<double> bar, Value value) {
  BenchRow row;
  row.id = "reflections." + id;
  row.unit = unit;
  row.bar = bar;
  row.run = [=](BenchContext& context) -> Result<BenchValue> {
    const auto walks = shared->get([&] { return measure_views(context, values, rounds); });
    if (!walks) return walks.error();
    const auto& [first, second] = (*walks)->views;
    BenchValue result = single_value(value(**walks), hash_of_both(first.hash, second.hash));
    result.scene = context.scene_or(kWetStreet);
    return result;
  };
  registry.add(std::move(row));
}

/// All views with and without the test of bounding spheres. The bar is on the frames that users get.
void add_sphere_rows(BenchRegistry& registry) {
  const std::array<WalkValue, 2> values = {{{"ibr.sphere_test", "on", ""}, {"ibr.sphere_test", "off", ""}}};
  const auto shared = std::make_shared<Once<TwoWalks>>();
  const auto add = [&](const std::string& id, const char* unit, std::optional<double> bar, auto value) {
    add_walk_row(registry, shared, values, kWorstViewRounds, id, unit, bar, value);
  };
  add("worst_over_median_view", "ratio", 2.0, [](const TwoWalks& v) { return worst_over_median(v.views[0]); });
  add("worst_view_ms", "ms", std::nullopt, [](const TwoWalks& v) { return worst_ms(v.views[0]); });
  add("median_view_ms", "ms", std::nullopt, [](const TwoWalks& v) { return median_ms(v.views[0]); });
  add("worst_over_median_view.without_sphere_test", "ratio", std::nullopt,
      [](const TwoWalks& v) { return worst_over_median(v.views[1]); });
  add("worst_view_ms.without_sphere_test", "ms", std::nullopt, [](const TwoWalks& v) { return worst_ms(v.views[1]); });
  add("median_view_ms.without_sphere_test", "ms", std::nullopt,
      [](const TwoWalks& v) { return median_ms(v.views[1]); });
  add("sphere_test_on_over_off", "ratio", std::nullopt,
      [](const TwoWalks& v) { return time_ratio(v.views[0], v.views[1]); });
}

/// What the paper's bound of a reflected proxy saves, and what it misses.
void add_paper_bound_rows(BenchRegistry& registry) {
  const std::array<WalkValue, 2> values = {
      {{"ibr.tile_bound", "paper", "reflection_proxies"}, {"ibr.tile_bound", "exact", "reflection_proxies"}}};
  const auto shared = std::make_shared<Once<TwoWalks>>();
  const auto add = [&](const std::string& id, const char* unit, auto value) {
    add_walk_row(registry, shared, values, kMeanViewRounds, "paper_bound." + id, unit, std::nullopt, value);
  };
  add("time_over_exact", "ratio", [](const TwoWalks& v) { return time_ratio(v.views[0], v.views[1]); });
  add("frames_that_differ", "share", [](const TwoWalks& v) {
    const auto frames = std::ranges::count_if(v.differing, [](double share) { return share > 0.0; });
    return static_cast<double>(frames) / static_cast<double>(v.differing.size());
  });
  add("pixels_that_differ", "share", [](const TwoWalks& v) {
    return std::accumulate(v.differing.begin(), v.differing.end(), 0.0) / static_cast<double>(v.differing.size());
  });
}

/// The screen-space pass with the paper's march of constant steps. Its error: flip_constant_over_hierarchical_march.
void add_march_rows(BenchRegistry& registry) {
  const std::array<WalkValue, 2> values = {
      {{"ssr.march", "constant", "reflection_screen_space"}, {"ssr.march", "hierarchical", "reflection_screen_space"}}};
  const auto shared = std::make_shared<Once<TwoWalks>>();
  const auto add = [&](const std::string& id, const char* unit, auto value) {
    add_walk_row(registry, shared, values, kMeanViewRounds, "march." + id, unit, std::nullopt, value);
  };
  add("constant_over_hierarchical", "ratio", [](const TwoWalks& v) { return time_ratio(v.views[0], v.views[1]); });
  add("constant_ms", "ms", [](const TwoWalks& v) { return median_ms(v.views[0]); });
  add("hierarchical_ms", "ms", [](const TwoWalks& v) { return median_ms(v.views[1]); });
}

}  // namespace

void add_reflection_view_benches(BenchRegistry& registry) {
  add_sphere_rows(registry);
  add_paper_bound_rows(registry);
  add_march_rows(registry);
}

}  // namespace gloam

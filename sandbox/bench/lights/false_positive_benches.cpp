// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <cstring>
#include <map>
#include <memory>
#include <string>
#include <utility>

#include "engine/core/hash.h"
#include "sandbox/bench/harness/benches.h"
#include "sandbox/bench/harness/context.h"
#include "sandbox/bench/harness/measure.h"

// How many lights a tile each phase keeps that reach none of its pixels, for the scene's camera at the size that was
// chosen.

namespace gloam {
namespace {

constexpr const char* kScene = "builtin:many_lights";  // unless the user names one
constexpr int kSettlingFrames = 3;

/// Knobs by name, and what they are set to while frames are counted.
using Settings = std::map<std::string, std::string>;
using Counters = std::map<std::string, double>;

Result<Counters> count_frame(Session& session, const Options& options, const Settings& settings) {
  KnobRegistry& knobs = session.renderer->knobs();
  Settings before;
  for (const auto& [name, value] : settings) {
    before[name] = knobs.text(name);
    GLOAM_TRY(knobs.set(name, value));
  }
  const ViewRequest request{session.view_settings(options.width, options.height, "none"), {}};
  Counters counters;
  for (int i = 0; i < kSettlingFrames; ++i) {
    const auto sample = session.render_frame(request);
    if (!sample) return sample.error();
    counters = sample->report.counters;
  }
  for (const auto& [name, value] : before) GLOAM_TRY(knobs.set(name, value));
  return counters;
}

/// Frames that were counted, so that rows of the same settings share one.
class CountedFrames {
 public:
  [[nodiscard]] Result<double> counter(BenchContext& context, const Settings& settings, const std::string& name) {
    if (!frames_.contains(settings)) {
      auto session = context.session_or(kScene);
      if (!session) return session.error();
      auto counted = count_frame(**session, context.options(), settings);
      if (!counted) return counted.error();
      frames_[settings] = std::move(counted).value();
    }
    const Counters& frame = frames_[settings];
    const auto found = frame.find(name);
    if (found == frame.end()) return Error{ErrorKind::failed, "a frame of this scene does not count " + name};
    return found->second;
  }

 private:
  std::map<Settings, Counters> frames_;
};

BenchValue value_of(const BenchContext& context, double value) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &value, sizeof(bits));
  return {.value = value,
          .p10 = {},
          .p90 = {},
          .hash = hash_text(Hasher().value(bits).digest()),
          .scene = context.scene_or(kScene)};
}

BenchRow counter_row(std::string id, std::string unit, std::shared_ptr<CountedFrames> frames, Settings settings,
                     std::string counter, std::string less = {}) {
  BenchRow row;
  row.id = std::move(id);
  row.unit = std::move(unit);
  row.run = [frames = std::move(frames), settings = std::move(settings), counter = std::move(counter),
             less = std::move(less)](BenchContext& context) -> Result<BenchValue> {
    const auto value = frames->counter(context, settings, counter);
    if (!value) return value.error();
    if (less.empty()) return value_of(context, *value);
    const auto right = frames->counter(context, settings, less);
    if (!right) return right.error();
    return value_of(context, *value - *right);
  };
  return row;
}

}  // namespace

void add_light_false_positive_benches(BenchRegistry& registry) {
  const auto frames = std::make_shared<CountedFrames>();
  const std::string exact = "lights.per_tile_accurate_mean";
  const auto mean_of = [](const std::string& phase) { return "lights.per_tile_" + phase + "_mean"; };
  registry.add(counter_row("lights.per_tile_accurate", "lights/tile", frames, {{"lights.culling", "tiled"}}, exact));
  for (const char* bound : {"rect", "row_interval", "cone"}) {
    for (const char* phase : {"mask", "candidates", "group", "approx"})
      registry.add(counter_row(std::string("lights.false_positives.") + bound + "." + phase, "lights/tile", frames,
                               {{"lights.culling", "tiled"}, {"lights.tile_bound", bound}}, mean_of(phase), exact));
  }
  for (const char* bins : {"256", "512", "1024", "2048", "4096"})
    registry.add(counter_row(std::string("lights.false_positives.z_bins.") + bins, "lights/tile", frames,
                             {{"lights.culling", "tiled"}, {"lights.z_bins", bins}}, mean_of("candidates"), exact));
  const Settings checked = {{"lights.culling", "tiled"}, {"lights.check", "on"}};
  for (const char* fault : {"culling_errors", "capacity_violations"}) {
    const std::string name = std::string("lights.") + fault;
    BenchRow row = counter_row(name, "count", frames, checked, name);
    row.bar = 0.0;
    registry.add(std::move(row));
  }
}

}  // namespace gloam

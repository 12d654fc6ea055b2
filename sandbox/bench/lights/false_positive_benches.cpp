// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <utility>

#include "engine/core/hash.h"
#include "sandbox/bench/harness/benches.h"
#include "sandbox/bench/harness/context.h"
#include "sandbox/bench/harness/measure.h"
#include "shaders/lights/lights_shared.h"

// False positives: number of lights per tile that each phase keeps although they reach none of its pixels. For the
// scene's camera at the chosen size.

namespace gloam {
namespace {

constexpr const char* kFalsePositiveScene = "builtin:many_lights";  // unless the user names one
constexpr int kSettlingFrames = 3;

/// Values of knobs while frames are counted, by knob name.
using Settings = std::map<std::string, std::string>;
using Counters = std::map<std::string, double>;

struct CountedFrame {
  Counters counters;
  std::uint64_t picture_hash = 0;
};

Result<CountedFrame> count_frame(Session& session, const Options& options, const Settings& settings) {
  KnobRegistry& knobs = session.renderer->knobs();
  Settings before;
  for (const auto& [name, value] : settings) {
    if (const Knob* knob = knobs.find(name)) before[name] = knobs.text(*knob);
    GLOAM_TRY(knobs.set(name, value));
  }
  const ViewRequest request{session.view_settings(options.width, options.height, "none"), {}};
  CountedFrame frame;
  for (int i = 0; i < kSettlingFrames; ++i) {
    const auto sample = session.render_frame(request);
    if (!sample) return sample.error();
    frame.counters = sample->report.counters;
  }
  const auto picture = session.renderer->read_picture(request.settings.id);
  if (!picture) return picture.error();
  frame.picture_hash = hash_bytes(std::as_bytes(std::span(picture->rgba)));
  for (const auto& [name, value] : before) GLOAM_TRY(knobs.set(name, value));
  return frame;
}

/// Counted frames. Rows with the same settings share one.
class CountedFrames {
 public:
  struct Counter {
    double value = 0.0;
    std::uint64_t picture_hash = 0;  ///< of the frame it was counted in
  };
  [[nodiscard]] Result<Counter> counter(BenchContext& context, const Settings& settings, const std::string& name) {
    if (!frames_.contains(settings)) {
      auto session = context.session_or(kFalsePositiveScene);
      if (!session) return session.error();
      auto counted = count_frame(**session, context.options(), settings);
      if (!counted) return counted.error();
      frames_[settings] = std::move(counted).value();
    }
    const CountedFrame& frame = frames_[settings];
    const auto found = frame.counters.find(name);
    if (found == frame.counters.end()) return Error{ErrorKind::failed, "a frame of this scene does not count " + name};
    return Counter{found->second, frame.picture_hash};
  }

 private:
  std::map<Settings, CountedFrame> frames_;
};

/// The value, with a hash of the number and of the picture of the counted frame.
BenchValue false_positives_of(const BenchContext& context, double value, std::uint64_t picture_hash) {
  BenchValue result = single_value(value, hash_of_both(hash_of_number(value), picture_hash));
  result.scene = context.scene_or(kFalsePositiveScene);
  return result;
}

BenchRow counter_row(std::string id, std::string unit, std::shared_ptr<CountedFrames> frames, Settings settings,
                     std::string counter, std::string less = {}) {
  BenchRow row;
  row.id = std::move(id);
  row.unit = std::move(unit);
  row.run = [frames = std::move(frames), settings = std::move(settings), counter = std::move(counter),
             less = std::move(less)](BenchContext& context) -> Result<BenchValue> {
    const auto counted = frames->counter(context, settings, counter);
    if (!counted) return counted.error();
    if (less.empty()) return false_positives_of(context, counted->value, counted->picture_hash);
    const auto right = frames->counter(context, settings, less);
    if (!right) return right.error();
    return false_positives_of(context, counted->value - right->value, counted->picture_hash);
  };
  return row;
}

/// MiB of one mask for each of the shadow tiles, or tile groups, of a 4K picture.
BenchRow mask_memory_row(const char* id, std::uint32_t tile_pixels) {
  const auto tiles = [&](std::uint32_t pixels) { return (pixels + tile_pixels - 1) / tile_pixels; };
  const double bytes = 4.0 * GLOAM_MASK_WORDS * tiles(3840) * tiles(2160);
  BenchRow row;
  row.id = std::string("lights.mask_mib.") + id + ".4k";
  row.unit = "MiB";
  row.run = [mib = bytes / 1048576.0](BenchContext&) -> Result<BenchValue> {
    return single_value(mib, hash_of_number(mib));
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
  registry.add(mask_memory_row("tiles", GLOAM_SHADOW_TILE));
  registry.add(mask_memory_row("groups", GLOAM_SHADOW_TILE * GLOAM_TILE_GROUP));
  const Settings checked = {{"lights.culling", "tiled"}, {"lights.check", "on"}};
  for (const char* fault : {"culling_errors", "capacity_violations"}) {
    const std::string name = std::string("lights.") + fault;
    BenchRow row = counter_row(name, "count", frames, checked, name);
    row.bar = 0.0;
    registry.add(std::move(row));
  }
}

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "engine/core/hash.h"
#include "modules/grass/knobs.h"
#include "sandbox/bench/grass/case.h"
#include "sandbox/bench/harness/benches.h"
#include "sandbox/bench/harness/context.h"
#include "sandbox/bench/harness/measure.h"
#include "sandbox/bench/harness/once.h"
#include "sandbox/session/loading/scene_loading.h"

// What shadows of blades add to frames by night, where several lamps shine on the grass.

namespace gloam {
namespace {

constexpr std::uint32_t kNightWidth = 640;
constexpr std::uint32_t kNightHeight = 360;
constexpr int kNightRounds = 7;
constexpr int kNightWarmUp = 2;
// Frames after a change that are not measured: the first draws whole maps, the next the depth of what rests.
constexpr int kSettled = 2;
constexpr const char* kLanterns = "lanterns";
constexpr const char* kCourtyard = "../shared/scenes/courtyard/courtyard.gltf";

struct NightCost {
  std::vector<double> with_ns, without_ns;
  std::uint64_t hash = 0;  ///< of the pictures with and without
};

/// Frames with shadows of blades and frames without them, in turn; time goes on, so the grass moves. Each time is the
/// mean of as many frames as maps take turns (grass.shadow_turns): together they draw every map.
Result<NightCost> measure_night(BenchContext& context, const std::string& scene, const std::string& camera) {
  auto session = context.open_builtin(scene);
  if (!session) return session.error();
  const auto found = find_camera((*session)->world, (*session)->info, camera);
  if (!found) return found.error();
  (*session)->camera = *found;
  ViewSettings settings = (*session)->view_settings(kNightWidth, kNightHeight, "none");
  KnobRegistry& knobs = (*session)->renderer->knobs();
  const std::string cast_distance = knobs.text(*knobs.find(kGrassCastDistance.name));
  const int turns = static_cast<int>(knobs.value(kGrassShadowTurns));
  NightCost cost;
  double time_s = 0.0;
  for (int round = -kNightWarmUp; round < kNightRounds; ++round)
    for (const bool with : {true, false}) {
      GLOAM_TRY(knobs.set(kGrassCastDistance.name, with ? cast_distance : "0"));
      double sum_ns = 0.0;
      for (int i = 0; i < kSettled + turns; ++i) {
        time_s += kGrassFrame_s;
        (*session)->set_clock(time_s, kGrassFrame_s);
        const auto sample = (*session)->render_frame({settings, {}});
        if (!sample) return sample.error();
        settings.camera_cut = false;
        if (i >= kSettled) sum_ns += sample->report.gpu_ms * kNsPerMs;
      }
      if (round >= 0) (with ? cost.with_ns : cost.without_ns).push_back(sum_ns / turns);
      const auto light = (*session)->renderer->read_linear(settings.id);
      if (!light) return light.error();
      cost.hash = hash_of_both(cost.hash, Hasher().items(std::span(light->rgba)).digest());
    }
  GLOAM_TRY(knobs.set(kGrassCastDistance.name, cast_distance));
  return cost;
}

void add_night_row(BenchRegistry& registry, const std::shared_ptr<Once<NightCost>>& shared, const std::string& scene,
                   const std::string& camera, const std::string& id, double bar, bool added) {
  BenchRow row;
  row.id = "grass.night." + id;
  row.unit = "ms";
  row.bar = bar;
  row.run = [=](BenchContext& context) -> Result<BenchValue> {
    std::error_code ignored;
    if (scene == kCourtyard && !std::filesystem::exists(kCourtyard, ignored))
      return skipped_row(std::string("there is no ") + kCourtyard);
    const auto cost = shared->get([&] { return measure_night(context, scene, camera); });
    if (!cost) return cost.error();
    const NightCost& c = **cost;
    BenchValue value =
        added ? excess_of(c.with_ns, c.without_ns, kNsPerMs, c.hash) : per_item(c.with_ns, kNsPerMs, c.hash);
    value.scene = scene;
    return value;
  };
  registry.add(std::move(row));
}

}  // namespace

void add_grass_night_benches(BenchRegistry& registry) {
  const auto meadow = std::make_shared<Once<NightCost>>(), lawn = std::make_shared<Once<NightCost>>();
  add_night_row(registry, meadow, kMeadow, kLanterns, "added_ms", 60.0, true);
  add_night_row(registry, lawn, kCourtyard, "lawn", "lawn_added_ms", 40.0, true);
  add_night_row(registry, lawn, kCourtyard, "lawn", "lawn_frame_ms", 200.0, false);
}

}  // namespace gloam

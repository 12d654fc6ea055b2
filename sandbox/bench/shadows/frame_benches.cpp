// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <array>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "sandbox/bench/harness/benches.h"
#include "sandbox/bench/harness/context.h"
#include "sandbox/bench/harness/gather_yardstick.h"
#include "sandbox/bench/harness/measure.h"
#include "sandbox/bench/harness/once.h"
#include "sandbox/bench/shadows/case.h"
#include "sandbox/bench/shadows/phases.h"
#include "sandbox/scenes/lamps/shadow_grid.h"

namespace gloam {
namespace {

constexpr const char* kShadowFrameScene = "builtin:shadow_grid";  // unless the user names one
constexpr std::size_t kShadowFrameLights = 20;  // number of lights that are kept of the built-in scene
constexpr double kShadowFrameLightsAPoint = 4.0;
constexpr int kBlocks = 15;
constexpr int kWarmUpBlocks = 2;
constexpr int kBlockFrames = 5;

/// Parts of a frame's time.
enum FramePart : std::size_t { kMaps, kLists, kShadows, kLighting, kRest, kOutside };
constexpr std::size_t kFrameParts = 6;
constexpr std::array<const char*, kFrameParts> kPartNames = {"maps", "lists", "shadows", "lighting", "rest", "outside"};

FramePart frame_part_of(const PassTime& pass) {
  if (makes_shadow_maps(pass)) return kMaps;
  const auto phase = shadow_phase_of(pass);
  if (!phase) return kRest;
  switch (*phase) {
    case ShadowPhase::prepare:
    case ShadowPhase::approx:
    case ShadowPhase::accurate:
      return kLists;
    case ShadowPhase::classify:
    case ShadowPhase::generate:
    case ShadowPhase::finish:
    case ShadowPhase::closeups:
      return kShadows;
    case ShadowPhase::lighting:
      break;
  }
  return kLighting;
}

struct ShadowFrames {
  std::vector<double> frame_ns;  ///< from the start of a frame's systems to the end of its work on the GPU
  std::vector<double> gpu_ns;
  std::vector<double> gather_ns;
  std::array<std::vector<double>, kFrameParts> part_ns;
  std::uint64_t hash = 0;         ///< of the last picture
  std::uint64_t gather_hash = 0;  ///< of the yardstick's picture
  double lights = 0.0;            ///< lights that cast shadows in the last frame
  double room = 1.0;              ///< share of frames in which every tile had room
};

void add_shadow_frame(ShadowFrames& frames, const FrameSample& sample) {
  std::array<double, kFrameParts> ms{};
  double passes_ms = 0.0;
  for (const PassTime& pass : sample.report.passes) {
    ms[frame_part_of(pass)] += pass.ms;
    passes_ms += pass.ms;
  }
  ms[kOutside] = sample.wall_ms() - passes_ms;
  for (std::size_t i = 0; i < kFrameParts; ++i) frames.part_ns[i].push_back(ms[i] * kNsPerMs);
  frames.frame_ns.push_back(sample.wall_ms() * kNsPerMs);
  frames.gpu_ns.push_back(sample.report.gpu_ms * kNsPerMs);
  frames.lights = counter_of(sample.report, "shadows.casting_lights");
  frames.room += lists_had_room(sample.report) ? 1.0 : 0.0;
}

Result<double> draw_gathers(GatherYardstick& yardstick) {
  const auto start = std::chrono::steady_clock::now();
  GLOAM_TRY(yardstick.draw());
  return std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - start).count();
}

/// Measures blocks of frames and blocks of gather passes alternately. Simulated time advances with each frame.
Result<ShadowFrames> measure_shadow_frames(Session& session, const Options& options) {
  auto yardstick = GatherYardstick::create(*session.device, options.width, options.height);
  if (!yardstick) return yardstick.error();
  ShadowCase shadows(session, options.width, options.height);
  GLOAM_TRY(shadows.set("shadows.mode", "deferred"));
  GLOAM_TRY(shadows.set("shadows.filter", "chs"));
  ShadowFrames frames;
  frames.room = 0.0;
  double time_s = options.time_s;
  for (int block = -kWarmUpBlocks; block < kBlocks; ++block) {
    for (int i = 0; i < kBlockFrames; ++i) {
      session.set_clock(time_s, options.dt_s);
      turn_shadow_grid_boards(session.world, time_s);
      time_s += options.dt_s;
      const auto sample = shadows.draw();
      if (!sample) return sample.error();
      if (block >= 0) add_shadow_frame(frames, *sample);
    }
    for (int i = 0; i < kBlockFrames; ++i) {
      const auto gather_ns = draw_gathers(**yardstick);
      if (!gather_ns) return gather_ns.error();
      if (block >= 0) frames.gather_ns.push_back(*gather_ns);
    }
  }
  const auto hash = shadows.picture_hash();
  if (!hash) return hash.error();
  frames.hash = *hash;
  const auto gather_hash = (*yardstick)->picture_hash();
  if (!gather_hash) return gather_hash.error();
  frames.gather_hash = *gather_hash;
  frames.room /= kBlocks * kBlockFrames;
  session.set_clock(options.time_s, options.dt_s);
  return frames;
}

/// Measures the scene that the user named with its animation, or else a separate session of the built-in scene with few
/// lights and turning boards.
Result<ShadowFrames> measure_chosen(BenchContext& context) {
  if (!context.options().scene_is_default) {
    auto session = context.session();
    if (!session) return session.error();
    return measure_shadow_frames(**session, context.options());
  }
  auto session = context.open_builtin(kShadowFrameScene);
  if (!session) return session.error();
  arrange_shadow_grid_lights((*session)->world, kShadowFrameLights, kShadowFrameLightsAPoint);
  return measure_shadow_frames(**session, context.options());
}

using SharedShadowFrames = std::shared_ptr<Once<ShadowFrames>>;

template <class Value>
void add_shadow_row(BenchRegistry& registry, const SharedShadowFrames& shared, const std::string& id, const char* unit,
                    std::optional<double> bar, Value value) {
  BenchRow row;
  row.id = "shadows.frame." + id;
  row.unit = unit;
  row.bar = bar;
  row.run = [shared, value](BenchContext& context) -> Result<BenchValue> {
    const auto frames = shared->get([&] { return measure_chosen(context); });
    if (!frames) return frames.error();
    BenchValue result = value(**frames);
    result.scene = context.scene_or(kShadowFrameScene);
    return result;
  };
  registry.add(std::move(row));
}

}  // namespace

void add_shadow_frame_benches(BenchRegistry& registry) {
  const auto shared = std::make_shared<Once<ShadowFrames>>();
  const auto times = [&](const std::string& id, std::vector<double> ShadowFrames::*ns) {
    add_shadow_row(registry, shared, id, "ms", std::nullopt,
                   [ns](const ShadowFrames& f) { return per_item(f.*ns, kNsPerMs, f.hash); });
  };
  times("whole_ms", &ShadowFrames::frame_ns);
  times("gpu_ms", &ShadowFrames::gpu_ns);
  add_shadow_row(registry, shared, "gather48_ms", "ms", std::nullopt,
                 [](const ShadowFrames& f) { return per_item(f.gather_ns, kNsPerMs, f.gather_hash); });
  add_shadow_row(registry, shared, "over_gather48", "ratio", 3.7, [](const ShadowFrames& f) {
    return ratio_of(f.frame_ns, f.gather_ns, hash_of_both(f.hash, f.gather_hash));
  });
  for (std::size_t i = 0; i < kFrameParts; ++i) {
    const std::string name = kPartNames[i];
    add_shadow_row(registry, shared, name + "_ms", "ms", std::nullopt,
                   [i](const ShadowFrames& f) { return per_item(f.part_ns[i], kNsPerMs, f.hash); });
    add_shadow_row(registry, shared, name + "_share", "share of the frame", std::nullopt,
                   [i](const ShadowFrames& f) { return ratio_of(f.part_ns[i], f.frame_ns, f.hash); });
  }
  add_shadow_row(registry, shared, "casting_lights", "lights", std::nullopt,
                 [](const ShadowFrames& f) { return single_value(f.lights, f.hash); });
  add_shadow_row(registry, shared, "with_room", "share of frames", std::nullopt,
                 [](const ShadowFrames& f) { return single_value(f.room, f.hash); });
}

}  // namespace gloam

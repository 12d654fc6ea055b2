// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "modules/accuracy/cost/picture_error.h"
#include "modules/accuracy/metrics/linear_error.h"
#include "modules/reflections/knobs.h"
#include "sandbox/bench/harness/benches.h"
#include "sandbox/bench/harness/context.h"
#include "sandbox/bench/harness/measure.h"
#include "sandbox/bench/harness/once.h"
#include "sandbox/bench/reflections/case.h"

// Changes of the picture from frame to frame during a walk, against the changes of a better sampled walk. Traced
// reflections would need minutes a frame without noise, so the reference is the same walk with the same tiers, with
// reflection images of full size and four times the samples of the constant screen-space march, without reprojection.

namespace gloam {
namespace {

constexpr std::uint32_t kTemporalWidth = 320;
constexpr std::uint32_t kTemporalHeight = 180;
constexpr std::size_t kTemporalFrames = 120;
constexpr std::size_t kWalkFrames = 480;  // of the whole recorded walk; the first kTemporalFrames are drawn
constexpr double kMoreSamples = 4.0;

/// The tier sets that draw reflection images. Probes alone have none to flicker.
constexpr std::array<const char*, 3> kWalkTiers = {"ssr+cube", "ibr+cube", "all"};

struct TemporalFlicker {
  double plain = 0.0;        ///< mean temporal error, cd/m² a frame
  double reprojected = 0.0;  ///< with reflections.temporal=on
  std::uint64_t plain_hash = 0;
  std::uint64_t reprojected_hash = 0;
};

using TemporalWalk = std::vector<LinearPicture>;

Result<TemporalWalk> draw_temporal_walk(ReflectionFrames& frames, const std::vector<dmat4>& poses) {
  TemporalWalk walk;
  for (const dmat4& pose : poses) {
    frames.look_from(pose);
    if (walk.empty()) frames.cut();
    if (const auto drawn = frames.draw(); !drawn) return drawn.error();
    auto light = frames.linear();
    if (!light) return light.error();
    walk.push_back(std::move(light).value());
  }
  return walk;
}

Status judge_walk(const TemporalWalk& reference, const TemporalWalk& drawn, double& error, std::uint64_t& hash) {
  std::vector<LinearPixels> expected, found;
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    expected.push_back(pixels_of(reference[i]));
    found.push_back(pixels_of(drawn[i]));
    hash = hash_of_both(hash, hash_of_both(hash_of_light(reference[i]), hash_of_light(drawn[i])));
  }
  const auto statistics = temporal_error(expected, found);
  if (!statistics) return statistics.error();
  error = statistics->mean;
  return {};
}

Result<TemporalFlicker> measure_temporal_walks(BenchContext& context, const char* tiers) {
  const std::string scene = context.scene_or(kWetStreet);
  auto session = context.open_builtin(scene);
  if (!session) return session.error();
  std::vector<dmat4> poses = recorded_walk(**session, scene, kWalkFrames, false);
  poses.resize(kTemporalFrames);
  const KnobRegistry& knobs = (*session)->renderer->knobs();
  const std::string resolution = text_of(kSsrFullResolution, knobs.value(kSsrFullResolution));
  const std::string samples = text_of(kSsrK1, knobs.value(kSsrK1));
  const double more_samples = std::min(kMoreSamples * knobs.value(kSsrK1), kSsrK1.max);
  ReflectionFrames frames(**session, kTemporalWidth, kTemporalHeight);
  GLOAM_TRY(frames.set("reflections.tiers", tiers));
  GLOAM_TRY(frames.set("reflections.temporal", "off"));
  GLOAM_TRY(frames.set("ssr.resolution", "full"));
  GLOAM_TRY(frames.set("ssr.k1", std::to_string(more_samples)));
  const auto reference = draw_temporal_walk(frames, poses);
  if (!reference) return reference.error();
  GLOAM_TRY(frames.set("ssr.resolution", resolution));
  GLOAM_TRY(frames.set("ssr.k1", samples));
  TemporalFlicker flicker;
  const auto plain = draw_temporal_walk(frames, poses);
  if (!plain) return plain.error();
  GLOAM_TRY(judge_walk(*reference, *plain, flicker.plain, flicker.plain_hash));
  GLOAM_TRY(frames.set("reflections.temporal", "on"));
  const auto reprojected = draw_temporal_walk(frames, poses);
  if (!reprojected) return reprojected.error();
  GLOAM_TRY(judge_walk(*reference, *reprojected, flicker.reprojected, flicker.reprojected_hash));
  return flicker;
}

}  // namespace

void add_reflection_temporal_benches(BenchRegistry& registry) {
  for (const char* tiers : kWalkTiers) {
    const auto shared = std::make_shared<Once<TemporalFlicker>>();
    const auto add = [&](const std::string& id, const char* unit, std::optional<double> bar, auto value) {
      BenchRow row;
      row.id = "reflections.temporal." + id;
      row.unit = unit;
      row.bar = bar;
      row.run = [=](BenchContext& context) -> Result<BenchValue> {
        const auto flicker = shared->get([&] { return measure_temporal_walks(context, tiers); });
        if (!flicker) return flicker.error();
        BenchValue result = value(**flicker);
        result.scene = context.scene_or(kWetStreet);
        return result;
      };
      registry.add(std::move(row));
    };
    add(tiers, "cd/m² a frame", std::nullopt,
        [](const TemporalFlicker& f) { return single_value(f.plain, f.plain_hash); });
    add(std::string(tiers) + ".reprojected", "cd/m² a frame", std::nullopt,
        [](const TemporalFlicker& f) { return single_value(f.reprojected, f.reprojected_hash); });
    if (tiers != std::string("all")) continue;
    add("reprojection_over_none", "ratio", 0.6, [](const TemporalFlicker& f) {
      return single_value(f.plain > 0.0 ? f.reprojected / f.plain : 0.0,
                          hash_of_both(f.plain_hash, f.reprojected_hash));
    });
  }
}

}  // namespace gloam

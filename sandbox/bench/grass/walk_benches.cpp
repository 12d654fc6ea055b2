// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <cmath>
#include <cstdint>
#include <memory>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/hash.h"
#include "modules/accuracy/cost/picture_error.h"
#include "modules/accuracy/metrics/flip.h"
#include "modules/accuracy/metrics/linear_error.h"
#include "sandbox/bench/grass/case.h"
#include "sandbox/bench/harness/benches.h"
#include "sandbox/bench/harness/context.h"
#include "sandbox/bench/harness/measure.h"
#include "sandbox/bench/harness/once.h"

// Pictures of a walk through builtin:meadow with the level of detail and without it. Changes from frame to frame are
// judged against those of the same walk without level of detail and with more samples a pixel. The blades stay at rest,
// so the level of detail alone differs.

namespace gloam {
namespace {

constexpr std::uint32_t kWalkWidth = 320;
constexpr std::uint32_t kWalkHeight = 180;
constexpr std::uint32_t kWalkSide = 4;  // samples of the reference in a pixel, along each axis
constexpr std::size_t kGrassWalkFrames = 60;
constexpr std::size_t kJudgedEvery = 10;  // frames
constexpr double kGrassFrame_s = 1.0 / 30.0;

struct GrassWalk {
  std::vector<LinearPicture> light;
  std::vector<Picture> pictures;  ///< every kJudgedEvery frames
  std::vector<double> coverage;   ///< of the same frames
  double live = 0.0;              ///< mean over the frames
};

struct WalkErrors {
  double temporal = 0.0;  ///< cd/m² a frame
  double temporal_without = 0.0;
  double flip = 0.0;
  double coverage = 0.0;
  double coverage_without = 0.0;
  double live = 0.0;
  double live_without = 0.0;
  std::uint64_t hash = 0;  ///< of the light of all walks
};

enum class Level { on, off };

Result<GrassWalk> draw_grass_walk(GrassCase& grass, Level level, std::uint32_t side) {
  GLOAM_TRY(grass.set("grass.lod_pixels", level == Level::on ? "1" : "0"));
  GLOAM_TRY(grass.set("grass.segments", level == Level::on ? "distance" : "full"));
  grass.set_size(side * kWalkWidth, side * kWalkHeight);
  GrassWalk walk;
  for (std::size_t i = 0; i < kGrassWalkFrames; ++i) {
    grass.set_time(kGrassFrame_s * static_cast<double>(i));
    const auto sample = grass.draw(0.0);  // the camera moves with the time; a frame without duration has no steps
    if (!sample) return sample.error();
    walk.live += counter_of(*sample, "grass.live") / kGrassWalkFrames;
    auto light = grass.linear();
    if (!light) return light.error();
    walk.light.push_back(averaged(*light, side));
    if (side > 1 || i % kJudgedEvery != 0) continue;
    auto picture = grass.picture();
    if (!picture) return picture.error();
    walk.pictures.push_back(std::move(picture).value());
    const auto coverage = grass.coverage();
    if (!coverage) return coverage.error();
    walk.coverage.push_back(*coverage);
  }
  return walk;
}

Result<double> temporal_mean(const GrassWalk& reference, const GrassWalk& drawn) {
  std::vector<LinearPixels> expected, found;
  for (std::size_t i = 0; i < kGrassWalkFrames; ++i) {
    expected.push_back(pixels_of(reference.light[i]));
    found.push_back(pixels_of(drawn.light[i]));
  }
  const auto statistics = temporal_error(expected, found);
  if (!statistics) return statistics.error();
  return statistics->mean;
}

double mean_flip(const GrassWalk& reference, const GrassWalk& drawn) {
  double sum = 0.0;
  for (std::size_t i = 0; i < drawn.pictures.size(); ++i) {
    const std::vector<float> map =
        flip_error_map(flip_features(pixels_of(reference.pictures[i])), flip_features(pixels_of(drawn.pictures[i])));
    sum += std::accumulate(map.begin(), map.end(), 0.0) / static_cast<double>(map.size());
  }
  return sum / static_cast<double>(drawn.pictures.size());
}

double mean_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

Result<WalkErrors> measure_grass_walks(BenchContext& context) {
  const auto grass = GrassCase::open(context, "walk", kWalkWidth, kWalkHeight);
  if (!grass) return grass.error();
  const auto reference = draw_grass_walk(**grass, Level::off, kWalkSide);
  if (!reference) return reference.error();
  const auto without = draw_grass_walk(**grass, Level::off, 1);
  if (!without) return without.error();
  const auto with = draw_grass_walk(**grass, Level::on, 1);
  if (!with) return with.error();
  const auto temporal = temporal_mean(*reference, *with);
  if (!temporal) return temporal.error();
  const auto temporal_without = temporal_mean(*reference, *without);
  if (!temporal_without) return temporal_without.error();
  Hasher hasher;
  for (const GrassWalk* walk : {&*reference, &*without, &*with})
    for (const LinearPicture& light : walk->light) hasher.items(light.rgba);
  return WalkErrors{.temporal = *temporal,
                    .temporal_without = *temporal_without,
                    .flip = mean_flip(*without, *with),
                    .coverage = mean_of(with->coverage),
                    .coverage_without = mean_of(without->coverage),
                    .live = with->live,
                    .live_without = without->live,
                    .hash = hasher.digest()};
}

}  // namespace

void add_grass_walk_benches(BenchRegistry& registry) {
  const auto shared = std::make_shared<Once<WalkErrors>>();
  const auto add = [&](const char* id, const char* unit, std::optional<double> bar, auto value) {
    BenchRow row;
    row.id = std::string("grass.") + id;
    row.unit = unit;
    row.bar = bar;
    row.run = [shared, value](BenchContext& context) -> Result<BenchValue> {
      const auto errors = shared->get([&] { return measure_grass_walks(context); });
      if (!errors) return errors.error();
      BenchValue result = single_value(value(**errors), (*errors)->hash);
      result.scene = kMeadow;
      return result;
    };
    registry.add(std::move(row));
  };
  using E = WalkErrors;
  add("walk.temporal_over_no_lod", "ratio", 1.1,
      [](const E& e) { return e.temporal_without > 0.0 ? e.temporal / e.temporal_without : 0.0; });
  add("walk.temporal", "cd/m² a frame", std::nullopt, [](const E& e) { return e.temporal; });
  add("walk.temporal_no_lod", "cd/m² a frame", std::nullopt, [](const E& e) { return e.temporal_without; });
  add("walk.flip", "FLIP", std::nullopt, [](const E& e) { return e.flip; });
  add("walk.live", "blades", std::nullopt, [](const E& e) { return e.live; });
  add("walk.live_no_lod", "blades", std::nullopt, [](const E& e) { return e.live_without; });
  add("coverage_difference", "share of pixels", std::nullopt,
      [](const E& e) { return std::abs(e.coverage - e.coverage_without); });
  add("coverage", "share of pixels", std::nullopt, [](const E& e) { return e.coverage; });
  add("coverage_no_lod", "share of pixels", std::nullopt, [](const E& e) { return e.coverage_without; });
}

}  // namespace gloam

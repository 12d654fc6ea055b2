// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
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
#include "sandbox/bench/harness/benches.h"
#include "sandbox/bench/harness/context.h"
#include "sandbox/bench/harness/measure.h"
#include "sandbox/bench/harness/once.h"
#include "sandbox/bench/reflections/case.h"

// Changes of the picture from frame to frame during a walk, against the changes of a better sampled walk. Traced
// reflections would need minutes a frame without noise, so the reference is the same walk with the same tiers, without
// reprojection, with one ray for each pixel of a picture of twice the width and height. The mean of four pixels is
// taken of the reflections alone (the light with reflections less the light without), and added to the light without
// them at the walk's size: edges of surfaces, which reprojection does not smooth, count as no error.

namespace gloam {
namespace {

constexpr std::uint32_t kTemporalWidth = 320;
constexpr std::uint32_t kTemporalHeight = 180;
constexpr std::size_t kTemporalFrames = 120;
constexpr std::size_t kWalkFrames = 480;  // of the whole recorded walk; the first kTemporalFrames are drawn
constexpr std::uint32_t kFiner = 2;       // size of the reference over that of the walk

/// The tier sets that draw reflection images. Probes alone have none to flicker.
constexpr std::array<const char*, 3> kWalkTiers = {"ssr+cube", "ibr+cube", "all"};

struct TemporalFlicker {
  double plain = 0.0;        ///< mean temporal error, cd/m² a frame
  double reprojected = 0.0;  ///< with reflections.temporal=on
  double full_size = 0.0;    ///< with ssr.resolution=full: what more rays give without reprojection
  std::uint64_t plain_hash = 0;
  std::uint64_t reprojected_hash = 0;
  std::uint64_t full_size_hash = 0;
};

using TemporalWalk = std::vector<LinearPicture>;

/// The mean of finer x finer pixels.
LinearPicture filtered(const LinearPicture& picture, std::uint32_t finer) {
  if (finer == 1) return picture;
  LinearPicture mean{picture.width / finer, picture.height / finer, {}};
  mean.rgba.assign(std::size_t{4} * mean.width * mean.height, 0.0f);
  for (std::uint32_t y = 0; y < mean.height * finer; ++y)
    for (std::uint32_t x = 0; x < mean.width * finer; ++x) {
      const std::size_t from = 4 * (std::size_t{y} * picture.width + x);
      const std::size_t to = 4 * (std::size_t{y / finer} * mean.width + x / finer);
      for (std::size_t c = 0; c < 4; ++c)
        mean.rgba[to + c] += picture.rgba[from + c] / static_cast<float>(finer * finer);
    }
  return mean;
}

using KnobValues = std::vector<std::pair<const char*, const char*>>;

/// The walk with these knobs' values, drawn with `finer` times the width and height and then filtered.
Result<TemporalWalk> draw_walk(Session& session, const std::vector<dmat4>& poses, std::uint32_t finer,
                               const KnobValues& knobs) {
  ReflectionFrames frames(session, kTemporalWidth * finer, kTemporalHeight * finer);
  for (const auto& [knob, value] : knobs) GLOAM_TRY(frames.set(knob, value));
  TemporalWalk walk;
  for (const dmat4& pose : poses) {
    frames.look_from(pose);
    if (walk.empty()) frames.cut();
    if (const auto drawn = frames.draw(); !drawn) return drawn.error();
    const auto light = frames.linear();
    if (!light) return light.error();
    walk.push_back(filtered(*light, finer));
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

Result<TemporalWalk> draw_reference_walk(Session& session, const std::vector<dmat4>& poses, const char* tiers) {
  auto reference = draw_walk(session, poses, 1, {{"reflections.mode", "off"}});
  if (!reference) return reference.error();
  const auto without = draw_walk(session, poses, kFiner, {{"reflections.mode", "off"}});
  if (!without) return without.error();
  const auto with =
      draw_walk(session, poses, kFiner,
                {{"reflections.tiers", tiers}, {"reflections.temporal", "off"}, {"ssr.resolution", "full"}});
  if (!with) return with.error();
  for (std::size_t frame = 0; frame < poses.size(); ++frame)
    for (std::size_t i = 0; i < (*reference)[frame].rgba.size(); ++i)
      (*reference)[frame].rgba[i] += (*with)[frame].rgba[i] - (*without)[frame].rgba[i];
  return reference;
}

Result<TemporalFlicker> measure_temporal_walks(BenchContext& context, const char* tiers) {
  const std::string scene = context.scene_or(kWetStreet);
  auto session = context.open_builtin(scene);
  if (!session) return session.error();
  std::vector<dmat4> poses = recorded_walk(**session, scene, kWalkFrames, false);
  poses.resize(kTemporalFrames);
  const auto reference = draw_reference_walk(**session, poses, tiers);
  if (!reference) return reference.error();
  TemporalFlicker flicker;
  const auto plain = draw_walk(**session, poses, 1, {{"reflections.tiers", tiers}, {"reflections.temporal", "off"}});
  if (!plain) return plain.error();
  GLOAM_TRY(judge_walk(*reference, *plain, flicker.plain, flicker.plain_hash));
  const auto reprojected =
      draw_walk(**session, poses, 1, {{"reflections.tiers", tiers}, {"reflections.temporal", "on"}});
  if (!reprojected) return reprojected.error();
  GLOAM_TRY(judge_walk(*reference, *reprojected, flicker.reprojected, flicker.reprojected_hash));
  const auto full_size = draw_walk(
      **session, poses, 1, {{"reflections.tiers", tiers}, {"reflections.temporal", "off"}, {"ssr.resolution", "full"}});
  if (!full_size) return full_size.error();
  GLOAM_TRY(judge_walk(*reference, *full_size, flicker.full_size, flicker.full_size_hash));
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
    add(std::string(tiers) + ".full_size", "cd/m² a frame", std::nullopt,
        [](const TemporalFlicker& f) { return single_value(f.full_size, f.full_size_hash); });
    if (tiers != std::string("all")) continue;
    add("reprojection_over_none", "ratio", 0.6, [](const TemporalFlicker& f) {
      return single_value(f.plain > 0.0 ? f.reprojected / f.plain : 0.0,
                          hash_of_both(f.plain_hash, f.reprojected_hash));
    });
  }
}

}  // namespace gloam

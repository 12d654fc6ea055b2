// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>

#include "modules/accuracy/cost/picture_error.h"
#include "modules/accuracy/module.h"
#include "modules/depth_of_field/reference/lens_reference.h"
#include "sandbox/bench/dof/case.h"
#include "sandbox/bench/harness/benches.h"
#include "sandbox/bench/harness/context.h"
#include "sandbox/bench/harness/measure.h"
#include "sandbox/bench/harness/once.h"
#include "sandbox/session/drawing/session_costs.h"

// Error of depth of field against frames through many points of the lens, by bokeh and resolution of the layers.

namespace gloam {
namespace {

constexpr std::uint32_t kDofErrorWidth = 320;
constexpr std::uint32_t kDofErrorHeight = 180;
constexpr std::uint32_t kDofErrorSamples = 256;
constexpr int kDofErrorDraws = 3;  // the last frame finds what earlier ones left over (shadow caches, light scale)
constexpr std::array<const char*, 2> kDofErrorResolutions = {"half", "full"};

struct DofError {
  double rmse = 0.0;       ///< linear light, cd/m²
  double flip = 0.0;       ///< mean, 0…1
  std::uint64_t hash = 0;  ///< of the compared and the expected light
};
struct DofErrors {
  std::array<DofError, kDofErrorResolutions.size()> by_resolution;
  DofError without;       ///< of the frame without depth of field
  DofError noise;         ///< change of the reference from half of the samples to all
  bool measured = false;  ///< false: no camera has a focus
};

Result<FramePictures> draw_resolution(SessionCosts& costs, const char* resolution) {
  GLOAM_TRY(costs.knobs().set("dof.resolution", resolution));
  for (int i = 0; i < kDofErrorDraws; ++i)
    if (const auto drawn = costs.draw(0); !drawn) return drawn.error();
  return costs.read();
}

Result<DofError> error_of(const PictureJudge& judge, const FramePictures& pictures, std::uint64_t expected) {
  LedgerRow row;
  GLOAM_TRY(judge.judge(pictures, row));
  return DofError{.rmse = row.rmse.value_or(0.0),
                  .flip = row.flip.value_or(ErrorPair{}).mean,
                  .hash = hash_of_both(hash_of_dof_light(pictures.linear), expected)};
}

Result<DofErrors> measure_dof_errors(BenchContext& context, Bokeh bokeh) {
  const auto frames = DofFrames::open(context, bokeh);
  if (!frames) return frames.error();
  DofErrors errors;
  if (*frames == nullptr) return errors;
  errors.measured = true;
  Options options = context.options();
  options.width = kDofErrorWidth;
  options.height = kDofErrorHeight;
  options.view = "none";
  options.time_s = 0.0;
  options.out = options.cache_dir.empty() ? "" : options.cache_dir + "/bench";
  SessionCosts costs((*frames)->session(), options);
  const ReferenceInfo reference = lens_reference("dof.resolution");
  const auto drawn = draw_resolution(costs, kDofErrorResolutions[0]);
  if (!drawn) return drawn.error();
  auto expected = costs.draw_reference(reference, *drawn, kDofErrorSamples);
  if (!expected) return expected.error();
  const auto rough = costs.draw_reference(reference, *drawn, kDofErrorSamples / 2);
  if (!rough) return rough.error();
  const std::uint64_t expected_hash = hash_of_dof_light(expected->linear);
  const PictureJudge judge(std::move(expected).value());
  const auto noise = error_of(judge, *rough, expected_hash);
  if (!noise) return noise.error();
  errors.noise = *noise;
  for (std::size_t i = 0; i < kDofErrorResolutions.size(); ++i) {
    const auto pictures = draw_resolution(costs, kDofErrorResolutions[i]);
    if (!pictures) return pictures.error();
    const auto error = error_of(judge, *pictures, expected_hash);
    if (!error) return error.error();
    errors.by_resolution[i] = *error;
  }
  (*frames)->turn(false);
  const auto sharp = draw_resolution(costs, kDofErrorResolutions[0]);
  if (!sharp) return sharp.error();
  const auto without = error_of(judge, *sharp, expected_hash);
  if (!without) return without.error();
  errors.without = *without;
  return errors;
}

void add_dof_error_rows(BenchRegistry& registry, Bokeh bokeh) {
  const auto shared = std::make_shared<Once<DofErrors>>();
  const auto add = [&](const std::string& name, const char* unit, double DofError::*value, auto choose) {
    BenchRow row{.id = std::string("dof.error.") + bokeh_name(bokeh) + "." + name, .unit = unit};
    row.run = [=](BenchContext& context) -> Result<BenchValue> {
      const auto errors = shared->get([&] { return measure_dof_errors(context, bokeh); });
      if (!errors) return errors.error();
      if (!(*errors)->measured) return skipped_row(kNoFocus);
      const DofError& error = choose(**errors);
      BenchValue result = single_value(error.*value, error.hash);
      result.scene = context.scene_or(kLensScene);
      return result;
    };
    registry.add(std::move(row));
  };
  const auto add_both = [&](const std::string& name, auto choose) {
    add(name + ".flip", "FLIP", &DofError::flip, choose);
    add(name + ".rmse", "cd/m²", &DofError::rmse, choose);
  };
  for (std::size_t i = 0; i < kDofErrorResolutions.size(); ++i)
    add_both(kDofErrorResolutions[i], [i](const DofErrors& errors) { return errors.by_resolution[i]; });
  add_both("without", [](const DofErrors& errors) { return errors.without; });
  add_both("reference_noise", [](const DofErrors& errors) { return errors.noise; });
}

}  // namespace

void add_dof_error_benches(BenchRegistry& registry) {
  for (const Bokeh bokeh : {Bokeh::round, Bokeh::hexagonal}) add_dof_error_rows(registry, bokeh);
}

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/bench/grass/tips.h"

#include "engine/core/assert.h"
#include "engine/core/hash.h"
#include "modules/grass/growth/blade_rows.h"
#include "modules/grass/simulation/wind.h"

namespace gloam {
namespace {

constexpr std::size_t kTip = kGrassKnots - 1;
constexpr double kMmPerM = 1000.0;

/// A patch of a reading, with the parts of its row that a blade's model needs.
struct ReadPatch {
  const GrassPatch& patch;
  std::span<const GrassBlade> blades;
  shaders::GrassPatchRow row{};
};

ReadPatch read_patch(const GrassField& field, std::uint32_t index) {
  ReadPatch read{
      field.patches[index],
      std::span(field.blades).subspan(std::size_t{index} * GLOAM_GRASS_PATCH_BLADES, GLOAM_GRASS_PATCH_BLADES)};
  read.row.box_from = read.patch.roots.min;
  read.row.box_size = read.patch.roots.max - read.patch.roots.min;
  return read;
}

DrawnTip drawn_tip(const GrassField& field, const GrassReading& reading, std::size_t live) {
  const std::uint32_t sorted = reading.blades[live];
  const ReadPatch read = read_patch(field, reading.patches[sorted / GLOAM_GRASS_PATCH_BLADES].patch);
  const std::uint32_t index = sorted % GLOAM_GRASS_PATCH_BLADES;
  const std::uint32_t master = read.blades[index].master % GLOAM_GRASS_PATCH_BLADES;
  const auto model = [&](std::uint32_t at) {
    return blade_model(read.row, pack_blade_row(read.blades[at], read.patch), field.types);
  };
  const shaders::GrassPose& pose = reading.poses[live];
  const dvec3 knot = dvec3(reading.knots[pose.first_knot + kTip]) - model(master).root;
  const auto turned_by = [&](const vec4& row) { return glm::dot(dvec3(row), knot); };
  return {.model = model(index),
          .wind_at = dvec3(vec3(wind_position(read.patch.origin))),
          .tip = dvec3(turned_by(pose.row0), turned_by(pose.row1), turned_by(pose.row2)),
          .master = master == index};
}

}  // namespace

std::vector<DrawnTip> drawn_tips(const GrassField& field, const GrassReading& reading, TipChoice choice,
                                 std::size_t most) {
  std::vector<std::size_t> candidates;
  for (std::size_t live = 0; live < reading.blades.size(); ++live) {
    const std::uint32_t sorted = reading.blades[live];
    const std::uint32_t patch = reading.patches[sorted / GLOAM_GRASS_PATCH_BLADES].patch;
    const std::uint32_t slot = patch * GLOAM_GRASS_PATCH_BLADES + sorted % GLOAM_GRASS_PATCH_BLADES;
    if (choice == TipChoice::all || field.blades[slot].master == slot) candidates.push_back(live);
  }
  const std::size_t count = std::min(most, candidates.size());
  std::vector<DrawnTip> tips;
  for (std::size_t i = 0; i < count; ++i)
    tips.push_back(drawn_tip(field, reading, candidates[i * candidates.size() / count]));
  return tips;
}

std::vector<dvec3> simulated_tips(std::span<const DrawnTip> blades, std::span<const shaders::GrassSteps> frames,
                                  TipSimulation simulation, JobExecutor& jobs) {
  std::vector<dvec3> tips(blades.size());
  jobs.parallel_for(blades.size(), 16, [&](JobRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      const DrawnTip& blade = blades[i];
      BladeState state = rest_state(blade.model);
      for (const shaders::GrassSteps& frame : frames) {
        BladeSteps steps;
        steps.wind = from_shader(frame.wind);
        steps.wind_at = blade.wind_at;
        steps.step_s = double{frame.step_s} / simulation.step_parts;
        steps.frame_steps = frame.frame_steps * simulation.step_parts;
        steps.iterations = simulation.iterations;
        advance_blade(blade.model, steps, steps.frame_steps, state);
      }
      tips[i] = state.at[kTip];
    }
  });
  return tips;
}

std::vector<dvec3> tips_of(std::span<const DrawnTip> blades) {
  std::vector<dvec3> tips;
  for (const DrawnTip& blade : blades) tips.push_back(blade.tip);
  return tips;
}

std::vector<dvec3> rest_tips(std::span<const DrawnTip> blades) {
  std::vector<dvec3> tips;
  for (const DrawnTip& blade : blades) tips.push_back(blade.model.rest[kTip]);
  return tips;
}

ErrorStatistics tip_error_mm(std::span<const dvec3> reference, std::span<const dvec3> tips) {
  GLOAM_ASSERT(reference.size() == tips.size(), "each tip has a reference");
  std::vector<float> errors;
  for (std::size_t i = 0; i < tips.size(); ++i)
    errors.push_back(static_cast<float>(kMmPerM * glm::length(tips[i] - reference[i])));
  return statistics_of(errors);
}

std::uint64_t hash_of_tips(std::span<const DrawnTip> drawn) {
  Hasher hasher;
  for (const DrawnTip& one : drawn) hasher.bytes_of(one.tip);
  return hasher.digest();
}

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string_view>

#include "engine/render/knobs/knob_table.h"

namespace gloam {

/// Threads of the simulation: one a knot, in workgroups of 32, 64 or 128; one a blade; or as suits the device.
enum class SimulationThreads : std::uint8_t { device, knots_32, knots_64, knots_128, blade };
[[nodiscard]] constexpr std::string_view name_of(SimulationThreads threads) {
  switch (threads) {
    case SimulationThreads::device:
      return "device";
    case SimulationThreads::knots_32:
      return "32";
    case SimulationThreads::knots_64:
      return "64";
    case SimulationThreads::knots_128:
      return "128";
    case SimulationThreads::blade:
      return "blade";
  }
  return {};
}

/// Slaves per master.
inline constexpr ChoiceKnob<std::uint32_t> kGrassSlaves{
    .name = "grass.masters",
    .meaning =
        "simulated blades to blades that copy them: 1:4 means one master and four slaves, 1:1 that every blade is "
        "simulated",
    .choices = {{"1:1", 0}, {"1:2", 2}, {"1:4", 4}, {"1:8", 8}, {"1:16", 16}},
    .default_value = 4,
    .exact = 0};
inline constexpr IntegerKnob<std::uint32_t> kGrassIterations{
    .name = "grass.iterations",
    .meaning = "passes over the constraints of a blade in each step of the simulation",
    .min = 1,
    .max = 8,
    .default_value = 3,
    .exact = 8,
    .unit = "iterations",
    .ledger_values = {1, 2, 3, 4, 6, 8}};
inline constexpr NumberKnob kGrassDensityScale{.name = "grass.density_scale",
                                               .meaning = "factor of the density of all grass",
                                               .max = 1000,
                                               .default_value = 1,
                                               .exact = 1,
                                               .ledger_values = {0.25, 0.5, 1, 2}};
inline constexpr NumberKnob kGrassLodPixels{
    .name = "grass.lod_pixels",
    .meaning =
        "width of a blade's root in the picture below which the field is thinned and the blades that remain are "
        "widened; 0: every blade is drawn",
    .max = 8,
    .default_value = 1,
    .exact = 0,
    .unit = "pixels",
    .ledger_values = {0, 0.5, 1, 2}};
inline constexpr IntegerKnob<std::uint32_t> kGrassThreshold{
    .name = "grass.threshold",
    .meaning = "greatest distance that is drawn, in 255ths of the range",
    .max = 254,
    .default_value = 254,
    .exact = 254,
    .ledger_values = {64, 128, 254}};
inline constexpr NumberKnob kGrassCastDistance{.name = "grass.cast_distance",
                                               .meaning = "distance from the camera up to which blades cast shadows",
                                               .max = 1000,
                                               .default_value = 6,
                                               .exact = 1000,
                                               .unit = "m",
                                               .ledger_values = {0, 3, 6, 12},
                                               .only_with = "shadows.mode=monolithic|deferred"};
inline constexpr ChoiceKnob<std::uint32_t> kGrassCasters{
    .name = "grass.casters",
    .meaning =
        "blades that cast shadows among those within grass.cast_distance: 1:4 means a quarter of them, four times "
        "as wide; the same ones in every frame. Where few blades grow, all cast",
    .choices = {{"1:1", 1}, {"1:2", 2}, {"1:4", 4}, {"1:8", 8}},
    .default_value = 4,
    .exact = 1,
    .only_with = "shadows.mode=monolithic|deferred"};
inline constexpr ChoiceKnob<std::uint32_t> kGrassShadowTurns{
    .name = "grass.shadow_turns",
    .meaning =
        "frames between updates of the blades in a shadow map: 1 is every frame. The maps take turns; where something "
        "else moves in a map, its blades are updated with it",
    .choices = {{"1", 1}, {"2", 2}, {"4", 4}},
    .default_value = 2,
    .exact = 1,
    .unit = "frames",
    .only_with = "shadows.mode=monolithic|deferred"};
inline constexpr ChoiceKnob<bool> kGrassAllSegments{
    .name = "grass.segments",
    .meaning = "segments of a blade: as many as its size in the picture needs (distance), or 15 (full)",
    .choices = {{"distance", false}, {"full", true}},
    .exact = true};
inline constexpr ChoiceKnob<bool> kGrassReadback{
    .name = "grass.dispatch",
    .meaning =
        "size of the simulation's dispatch: from this frame on the GPU (indirect), or from an earlier frame on "
        "the CPU (readback)",
    .choices = {{"indirect", false}, {"readback", true}},
    .exact = false};
inline constexpr ChoiceKnob<bool> kGrassFarSteps{.name = "grass.far_steps",
                                                 .meaning =
                                                     "steps of the simulation for blades that are small in the "
                                                     "picture: each by itself (one), or two or four at once "
                                                     "(several)",
                                                 .choices = {{"several", true}, {"one", false}},
                                                 .default_value = true,
                                                 .exact = false};
inline constexpr EnumKnob<SimulationThreads> kGrassThreads{
    .name = "grass.group",
    .meaning =
        "threads of a workgroup of the simulation, 16 for each blade (32, 64, 128); one thread for each blade "
        "(blade); or what is faster on this kind of device (device)",
    .exact = SimulationThreads::blade};

/// Values of the module's knobs.
struct GrassKnobs {
  std::uint32_t slaves_per_master = 4;  ///< 0: every blade is simulated
  std::uint32_t iterations = 3;         ///< of constraints in each step
  double density_scale = 1.0;           ///< factor of GrassSurface::density
  float lod_pixels = 1.0f;              ///< least width of a blade's root, pixels; 0: no thinning
  std::uint32_t threshold = 254;        ///< greatest key that is drawn
  float cast_distance_m = 6.0f;         ///< blades nearer than this cast shadows
  std::uint32_t cast_every = 4;         ///< of so many near blades one casts shadows, as many times as wide
  std::uint32_t shadow_turns = 2;       ///< CasterSource::turns of blades
  SimulationThreads threads = SimulationThreads::device;
  bool readback = false;      ///< the CPU sizes the simulation's dispatch by an earlier frame's count
  bool far_steps = true;      ///< blades that are small in the picture run two or four steps at once
  bool all_segments = false;  ///< every blade has 15 segments, however small it is in the picture
};

void add_grass_knobs(KnobRegistry& registry);
[[nodiscard]] GrassKnobs grass_knobs(const KnobRegistry& registry);

}  // namespace gloam

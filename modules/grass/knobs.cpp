// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/grass/knobs.h"

#include <string>
#include <utility>
#include <vector>

namespace gloam {
namespace {

Knob grass_knob(std::string name, std::string meaning) {
  Knob knob;
  knob.name = std::move(name);
  knob.module = "grass";
  knob.meaning = std::move(meaning);
  return knob;
}

void add_choice(KnobRegistry& registry, std::string name, std::string meaning, std::vector<std::string> choices,
                double fallback, std::string exact) {
  Knob knob = grass_knob(std::move(name), std::move(meaning));
  knob.choices = std::move(choices);
  knob.default_number = fallback;
  knob.exact = std::move(exact);
  registry.add(std::move(knob));
}

Knob number(std::string name, std::string meaning, std::string unit, double min, double max, double fallback) {
  Knob knob = grass_knob(std::move(name), std::move(meaning));
  knob.type = Knob::Type::number;
  knob.unit = std::move(unit);
  knob.min = min;
  knob.max = max;
  knob.default_number = fallback;
  return knob;
}

Knob integer(std::string name, std::string meaning, std::string unit, double min, double max, double fallback) {
  Knob knob = number(std::move(name), std::move(meaning), std::move(unit), min, max, fallback);
  knob.type = Knob::Type::integer;
  return knob;
}

constexpr std::uint32_t kSlaves[] = {0, 2, 4, 8, 16};

}  // namespace

void add_grass_knobs(KnobRegistry& registry) {
  add_choice(registry, "grass.masters",
             "simulated blades to blades that copy them: 1:4 means one master and four slaves, 1:1 that every blade is "
             "simulated",
             {"1:1", "1:2", "1:4", "1:8", "1:16"}, 2, "1:1");
  Knob iterations = integer("grass.iterations", "passes over the constraints of a blade in each step of the simulation",
                            "iterations", 1, 8, 3);
  iterations.ledger_values = {1, 2, 3, 4, 6, 8};
  iterations.exact = "8";
  registry.add(std::move(iterations));
  Knob density = number("grass.density_scale", "factor of the density of all grass", "", 0, 1000, 1);
  density.ledger_values = {0.25, 0.5, 1, 2};
  registry.add(std::move(density));
  Knob pixels = number("grass.lod_pixels",
                       "width of a blade's root in the picture below which the field is thinned and the blades that "
                       "remain are widened; 0: every blade is drawn",
                       "pixels", 0, 8, 1);
  pixels.ledger_values = {0, 0.5, 1, 2};
  pixels.exact = "0";
  registry.add(std::move(pixels));
  Knob threshold =
      integer("grass.threshold", "greatest distance that is drawn, in 255ths of the range", "", 0, 254, 254);
  threshold.ledger_values = {64, 128, 254};
  threshold.exact = "254";
  registry.add(std::move(threshold));
  Knob cast =
      number("grass.cast_distance", "distance from the camera up to which blades cast shadows", "m", 0, 1000, 6);
  cast.ledger_values = {0, 3, 6, 12};
  cast.exact = "12";
  registry.add(std::move(cast));
  add_choice(registry, "grass.segments",
             "segments of a blade: as many as its size in the picture needs (distance), or 15 (full)",
             {"distance", "full"}, 0, "full");
  add_choice(
      registry, "grass.dispatch",
      "size of the simulation's dispatch: from this frame on the GPU (indirect), or from an earlier frame on the "
      "CPU (readback)",
      {"indirect", "readback"}, 0, "");
  add_choice(registry, "grass.group",
             "threads of a workgroup of the simulation, 16 for each blade (32, 64, 128); one thread for each blade "
             "(blade); or what is faster on this kind of device (device)",
             {"device", "32", "64", "128", "blade"}, 0, "");
}

GrassKnobs grass_knobs(const KnobRegistry& registry) {
  GrassKnobs knobs;
  knobs.slaves_per_master = kSlaves[registry.choice("grass.masters")];
  knobs.iterations = static_cast<std::uint32_t>(registry.number("grass.iterations"));
  knobs.density_scale = registry.number("grass.density_scale");
  knobs.lod_pixels = static_cast<float>(registry.number("grass.lod_pixels"));
  knobs.threshold = static_cast<std::uint32_t>(registry.number("grass.threshold"));
  knobs.cast_distance_m = static_cast<float>(registry.number("grass.cast_distance"));
  knobs.threads = static_cast<SimulationThreads>(registry.choice("grass.group"));
  knobs.readback = registry.is("grass.dispatch", "readback");
  knobs.all_segments = registry.is("grass.segments", "full");
  return knobs;
}

}  // namespace gloam

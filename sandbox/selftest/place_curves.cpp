// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <cmath>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/text/formatted.h"
#include "sandbox/selftest/checks.h"

namespace gloam {
namespace {

/// A curve of one scene: its picture against that of the first case, by what a number changes.
struct PlaceCurve {
  std::string name;
  std::string sentence;
  std::string axis;
  const char* unit_of_axis;
  StabilityRange promised;
  std::vector<double> values;
  std::vector<double> quick_values;
  Placement (*place)(double value);
};

const std::vector<PlaceCurve>& place_curves() {
  static const std::vector<PlaceCurve> all = {
      {.name = "moved",
       .sentence = "moved away from the origin",
       .axis = "distance from the origin, m",
       .unit_of_axis = "m",
       .promised = {1.0, 1e6},
       .values = {1.0, 10.0, 1e3, 1e5, 1e6, 1e8, 1e10},
       .quick_values = {1e3, 1e6},
       .place = [](double value) { return Placement{.moved = value * dvec3(1.0, 0.25, -0.5)}; }},
      {.name = "scaled",
       .sentence = "with all lengths multiplied, and the key gloam.scale",
       .axis = "factor on all lengths",
       .unit_of_axis = "",
       .promised = {1e-3, 1e3},
       .values = {1e-5, 1e-4, 1e-3, 1e-2, 0.1, 10.0, 100.0, 1e3, 1e4, 1e5},
       .quick_values = {1e-3, 1e3},
       .place = [](double value) { return Placement{.scale = value}; }},
  };
  return all;
}

Status run_place(SelfTestContext& context, StabilityCheck& check, const PlaceCurve& curve, const EffectScene& scene) {
  const auto first = context.draw(scene);
  if (!first) return first.error();
  for (const double value : context.quick() ? curve.quick_values : curve.values) {
    const auto moved = context.draw(scene, curve.place(value));
    const bool inside = value >= curve.promised.low && value <= curve.promised.high;
    if (!moved && inside) return moved.error();
    if (!moved) continue;  // beyond the range, a file may be refused
    add_point(check, value, mean_difference(*first, *moved), formatted("%g %s", value, curve.unit_of_axis));
  }
  return {};
}

}  // namespace

void add_place_curves(std::vector<SelfTestCheck>& checks) {
  for (const PlaceCurve& curve : place_curves())
    for (const EffectScene& scene : effect_scenes())
      checks.push_back({{.name = curve.name + "." + std::string(scene.name),
                         .kind = StabilityKind::curve,
                         .sentence = "a scene of " + std::string(scene.effect) + ", " + curve.sentence,
                         .unit = "of 255",
                         .bound = 0.5,
                         .advice = "Keep scenes of this effect within the range where it holds (docs/limits.md)",
                         .axis = curve.axis,
                         .promised = curve.promised},
                        scene.quick,
                        [&curve, &scene](SelfTestContext& context, StabilityCheck& check) {
                          return run_place(context, check, curve, scene);
                        }});
}

}  // namespace gloam

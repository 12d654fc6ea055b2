// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/scenes/builtin.h"

#include <string>
#include <vector>

#include "engine/core/text/nearest_name.h"
#include "sandbox/scenes/dusk/scene.h"
#include "sandbox/scenes/lamps/backlight.h"
#include "sandbox/scenes/lamps/closeups.h"
#include "sandbox/scenes/lamps/lanterns.h"
#include "sandbox/scenes/lamps/many_lights.h"
#include "sandbox/scenes/lamps/penumbra.h"
#include "sandbox/scenes/lamps/shadow_grid.h"
#include "sandbox/scenes/lamps/shadows.h"
#include "sandbox/scenes/lens.h"
#include "sandbox/scenes/meadow/scene.h"
#include "sandbox/scenes/plain.h"
#include "sandbox/scenes/smoke.h"
#include "sandbox/scenes/wet_street/scene.h"

namespace gloam {
namespace {

constexpr BuiltinScene kScenes[] = {
    {"dusk", "the showcase of all effects: a wet street with shops, stalls and a fire beside a lawn, after sunset",
     &build_dusk_scene},
    {"plain", "geometry and materials under one sun", &build_plain_scene},
    {"lanterns", "256 coloured point and spot lights between arches", &build_lanterns_scene},
    {"many_lights", "1024 small lights among stones and glass on hills, and a moon", &build_many_lights_scene},
    {"penumbra", "the penumbra of one straight edge under a wide lamp", &build_penumbra_scene},
    {"shadows", "soft shadows of columns, bars, a table and thin sheets under a lamp, a spot and a moon",
     &build_shadows_scene},
    {"shadow_grid", "256 lamps under a pergola that all cast shadows, about three at a point",
     &build_shadow_grid_scene},
    {"closeups", "eight figures, all close-up subjects, under eight lamps and a moon", &build_closeups_scene},
    {"wet_street", "puddles of a street at dusk that reflect facades, 60 lamps and a fire", &build_wet_street_scene},
    {"meadow", "grass by night in the wind, bent by rolling balls and a walker, under lanterns and a moon",
     &build_meadow_scene},
    {"meadow_day", "the grass of meadow under a sun", &build_meadow_day_scene},
    {"smoke", "smoke between a warm and a cold lamp, a fire on wet ground, dust in a beam and ground fog",
     &build_smoke_scene},
    {"lens",
     "depth of field through a round and a hexagonal aperture: pieces on a table, a wire, and lamps far and near",
     &build_lens_scene},
    {"backlight", "light through paper, leaves, wax and jade, with a lamp and a low sun behind them",
     &build_backlight_scene},
};

}  // namespace

std::span<const BuiltinScene> builtin_scenes() { return kScenes; }

Result<const BuiltinScene*> find_builtin_scene(std::string_view name) {
  std::vector<std::string> names;
  for (const BuiltinScene& scene : kScenes) {
    if (scene.name == name) return &scene;
    names.emplace_back(scene.name);
  }
  return Error{ErrorKind::usage, "there is no built-in scene '" + std::string(name) + "'; " + valid_names(name, names)};
}

}  // namespace gloam

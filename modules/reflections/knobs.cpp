// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/knobs.h"

#include <string>
#include <utility>
#include <vector>

namespace gloam {
namespace {

Knob choice_knob(std::string name, std::string meaning, std::vector<std::string> choices, double fallback) {
  Knob knob;
  knob.name = std::move(name);
  knob.module = "reflections";
  knob.meaning = std::move(meaning);
  knob.choices = std::move(choices);
  knob.default_number = fallback;
  return knob;
}

Knob number_knob(std::string name, std::string meaning, double min, double max, double fallback, std::string unit,
                 std::vector<double> ledger_values) {
  Knob knob = choice_knob(std::move(name), std::move(meaning), {}, fallback);
  knob.type = Knob::Type::number;
  knob.min = min;
  knob.max = max;
  knob.unit = std::move(unit);
  knob.ledger_values = std::move(ledger_values);
  return knob;
}

void add_tier_knobs(KnobRegistry& registry) {
  registry.add(choice_knob("reflections.mode",
                           "reflections by tiers, each the fallback of the one before (tiers), by drawing the scene "
                           "mirrored at one plane (planar), or of the sky alone (off)",
                           {"tiers", "planar", "off"}, 0));
  registry.add(choice_knob("reflections.tiers",
                           "tiers of reflections: screen space (ssr), image-based proxies (ibr), probes (cube)",
                           {"cube", "ssr+cube", "ibr+cube", "all"}, 3));
  registry.add(choice_knob("reflections.temporal",
                           "whether reflections are accumulated over frames, reprojected by the mirrored position",
                           {"off", "on"}, 0));
  registry.add(choice_knob("reflections.roughness",
                           "width of the blur of reflections: one for all surfaces, as in the paper (constant), or by "
                           "each surface's roughness (pixel)",
                           {"constant", "pixel"}, 1));
  registry.add(choice_knob("reflections.blur", "whether reflections are blurred by the distance of what they show",
                           {"off", "on"}, 1));
  registry.add(choice_knob("reflections.light_scale",
                           "whether captured colours follow lights that have changed since the capture", {"off", "on"},
                           1));
}

void add_screen_space_knobs(KnobRegistry& registry) {
  registry.add(number_knob("ssr.k1", "samples of the constant march near the camera: max(1, k1 · exp(−k2 · depth))", 1,
                           256, 32, "samples", {8, 16, 32, 64}));
  registry.add(number_knob("ssr.k2", "how fast that number falls with depth", 0, 1, 0.02, "1/m", {0, 0.02, 0.05, 0.1}));
  registry.add(number_knob("ssr.reach",
                           "height above the reflecting surface up to which rays are followed; proxies and probes show "
                           "what is higher",
                           0.1, 1000, 8, "m", {1, 2, 4, 8, 16}));
  Knob refine = number_knob("ssr.refine", "steps of the binary search for the hit", 0, 16, 5, "steps", {0, 2, 4, 5, 6});
  refine.type = Knob::Type::integer;
  registry.add(refine);
  registry.add(
      choice_knob("ssr.resolution", "size of the reflection images, relative to the picture", {"half", "full"}, 0));
  registry.add(choice_knob("ssr.march",
                           "steps of the screen-space march: constant in metres, or by tiles of the depth image and "
                           "pixels where a tile holds something near the ray (hierarchical)",
                           {"constant", "hierarchical"}, 1));
}

void add_proxy_knobs(KnobRegistry& registry) {
  registry.add(choice_knob("ibr.tiles", "vertical screen tiles with a list of proxies each",
                           {"1", "4", "8", "16", "32", "64"}, 3));
  registry.add(choice_knob("ibr.tile_bound",
                           "screen range of a reflected proxy: exact, or by the heuristic of the paper, which can miss "
                           "hits",
                           {"exact", "paper"}, 0));
  Knob layers = number_knob("ibr.layers", "nearest layers along a reflected ray that are blended", 1, 4, 4, "layers",
                            {1, 2, 3, 4});
  layers.type = Knob::Type::integer;
  registry.add(layers);
  registry.add(choice_knob("ibr.sphere_test", "whether a proxy's bounding sphere is tested before its rectangle",
                           {"off", "on"}, 1));
  registry.add(choice_knob("ibr.loop",
                           "proxies that a pixel tests: those of its tile (tiles), or all of the world (naive)",
                           {"tiles", "naive"}, 0));
}

}  // namespace

void add_reflection_knobs(KnobRegistry& registry) {
  add_tier_knobs(registry);
  add_screen_space_knobs(registry);
  add_proxy_knobs(registry);
}

ReflectionKnobs reflection_knobs(const KnobRegistry& registry) {
  ReflectionKnobs knobs;
  knobs.mode = static_cast<ReflectionKnobs::Mode>(registry.choice("reflections.mode"));
  const std::uint32_t tiers = registry.choice("reflections.tiers");
  knobs.screen_space = (tiers & 1u) != 0;
  knobs.proxies = (tiers & 2u) != 0;
  // The mirrored picture takes the place of both.
  if (knobs.mode == ReflectionKnobs::Mode::planar) knobs.screen_space = knobs.proxies = false;
  knobs.temporal = registry.is("reflections.temporal", "on");
  knobs.pixel_roughness = registry.is("reflections.roughness", "pixel");
  knobs.blur = registry.is("reflections.blur", "on");
  knobs.light_scale = registry.is("reflections.light_scale", "on");
  knobs.k1 = static_cast<float>(registry.number("ssr.k1"));
  knobs.k2 = static_cast<float>(registry.number("ssr.k2"));
  knobs.reach_m = static_cast<float>(registry.number("ssr.reach"));
  knobs.refine = static_cast<std::uint32_t>(registry.number("ssr.refine"));
  knobs.full_resolution = registry.is("ssr.resolution", "full");
  knobs.hierarchical = registry.is("ssr.march", "hierarchical");
  constexpr std::uint32_t kTiles[] = {1, 4, 8, 16, 32, 64};
  knobs.tiles.tiles = kTiles[registry.choice("ibr.tiles")];
  knobs.tiles.bound = registry.is("ibr.tile_bound", "paper") ? ProxyTileBound::paper : ProxyTileBound::exact;
  knobs.layers = static_cast<std::uint32_t>(registry.number("ibr.layers"));
  knobs.sphere_test = registry.is("ibr.sphere_test", "on");
  knobs.naive = registry.is("ibr.loop", "naive");
  return knobs;
}

}  // namespace gloam

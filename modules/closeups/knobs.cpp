// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/closeups/knobs.h"

#include <utility>

namespace gloam {
namespace {

Knob closeup_knob(std::string name, std::string meaning, std::vector<std::string> choices, double fallback) {
  Knob knob;
  knob.name = "closeups." + std::move(name);
  knob.module = "closeups";
  knob.meaning = std::move(meaning);
  knob.choices = std::move(choices);
  knob.default_number = fallback;
  return knob;
}

}  // namespace

void add_closeup_knobs(KnobRegistry& registry) {
  Knob pairs = closeup_knob("max_pairs",
                            "most pairs of a close-up subject and a light that get a separate shadow map; the subjects "
                            "of all other pairs are drawn into the light's standard maps",
                            {}, 8.0);
  pairs.type = Knob::Type::integer;
  pairs.max = 256.0;
  pairs.ledger_values = {0.0, 1.0, 2.0, 4.0, 8.0, 16.0};
  registry.add(pairs);
  Knob density = closeup_knob(
      "texels_per_pixel",
      "close-up map texels along a pixel's side, in the tiles that the shadow may touch; the map's side is "
      "rounded to a power of two, at most 2048",
      {}, 1.0);
  density.type = Knob::Type::number;
  density.unit = "texels a pixel";
  density.min = 0.25;
  density.max = 8.0;
  density.ledger_values = {0.25, 0.5, 1.0, 2.0, 4.0};
  registry.add(density);
  registry.add(closeup_knob(
      "filter",
      "filter of close-up maps when shadows.filter=chs: the same as for standard maps (chs), or single fetches "
      "(pcss), which are more exact in wide penumbrae of small subjects",
      {"chs", "pcss"}, 1.0));
  registry.add(
      closeup_knob("batch", "close-up pairs that are drawn into the close-up map together", {"1", "2", "4"}, 0.0));
  registry.add(closeup_knob("standard",
                            "how close-up subjects shadow forward-lit surfaces: their close-up maps are copied into "
                            "the light's standard maps (transfer), or they are drawn into these as well (draw)",
                            {"transfer", "draw"}, 0.0));
}

CloseupKnobs closeup_knobs(const KnobRegistry& registry) {
  CloseupKnobs knobs;
  knobs.max_pairs = static_cast<std::uint32_t>(registry.number("closeups.max_pairs"));
  knobs.texels_per_pixel = static_cast<float>(registry.number("closeups.texels_per_pixel"));
  knobs.batch = 1u << registry.choice("closeups.batch");
  knobs.single_fetches = registry.is("closeups.filter", "pcss");
  knobs.draws_standard = registry.is("closeups.standard", "draw");
  return knobs;
}

CloseupSettings closeup_settings(const CloseupKnobs& knobs, bool enabled) {
  CloseupSettings settings;
  settings.enabled = enabled && knobs.max_pairs > 0;
  settings.max_pairs = knobs.max_pairs;
  settings.batch = knobs.batch;
  settings.texels_per_pixel = knobs.texels_per_pixel;
  return settings;
}

}  // namespace gloam

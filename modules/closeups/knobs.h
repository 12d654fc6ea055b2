// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "engine/render/knobs/knob_table.h"
#include "modules/closeups/pairs/views.h"

namespace gloam {

inline constexpr IntegerKnob<std::uint32_t> kMostCloseupPairs{
    .name = "closeups.max_pairs",
    .meaning =
        "most pairs of a close-up subject and a light that get a separate shadow map; the subjects of all other "
        "pairs are drawn into the light's standard maps",
    .max = 256,
    .default_value = 8,
    .ledger_values = {0.0, 1.0, 2.0, 4.0, 8.0, 16.0},
    .only_with = "shadows.mode=deferred"};
inline constexpr NumberKnob kCloseupTexelsPerPixel{
    .name = "closeups.texels_per_pixel",
    .meaning =
        "close-up map texels along a pixel's side, in the tiles that the shadow may touch; the map's side is "
        "rounded to a power of two, at most 2048",
    .min = 0.25,
    .max = 8.0,
    .default_value = 1.0,
    .unit = "texels a pixel",
    .ledger_values = {0.25, 0.5, 1.0, 2.0, 4.0},
    .only_with = "closeups.max_pairs>0"};
inline constexpr ChoiceKnob<bool> kCloseupSingleFetches{
    .name = "closeups.filter",
    .meaning =
        "filter of close-up maps when shadows.filter=chs: the same as for standard maps (chs), or single fetches "
        "(pcss), which are more exact in wide penumbrae of small subjects",
    .choices = {{"chs", false}, {"pcss", true}},
    .default_value = true,
    .only_with = "shadows.filter=chs and closeups.max_pairs>0"};
inline constexpr ChoiceKnob<std::uint32_t> kCloseupBatch{
    .name = "closeups.batch",
    .meaning = "close-up pairs that are drawn into the close-up map together",
    .choices = {{"1", 1}, {"2", 2}, {"4", 4}},
    .default_value = 1,
    .only_with = "closeups.max_pairs>0"};
inline constexpr ChoiceKnob<bool> kCloseupDrawsStandard{
    .name = "closeups.standard",
    .meaning =
        "how close-up subjects shadow forward-lit surfaces: their close-up maps are copied into the light's "
        "standard maps (transfer), or they are drawn into these as well (draw)",
    .choices = {{"transfer", false}, {"draw", true}},
    .only_with = "closeups.max_pairs>0"};

/// Values of this module's knobs.
struct CloseupKnobs {
  std::uint32_t max_pairs = 8;
  float texels_per_pixel = 1.0f;
  std::uint32_t batch = 1;      ///< pairs that share the close-up map at a time: 1, 2 or 4
  bool single_fetches = true;   ///< filter of close-up maps: single fetches; false: the filter of standard maps
  bool keeps_maps = true;       ///< shadows.reuse is not off: maps of subjects that hold still are kept
  bool draws_standard = false;  ///< true: subjects are drawn into the overlay; false: transferred from the close-up map
};

void add_closeup_knobs(KnobRegistry& registry);
[[nodiscard]] CloseupKnobs closeup_knobs(const KnobRegistry& registry);
/// `enabled`: shadows.mode = deferred. The settings are disabled as well if max_pairs is 0.
[[nodiscard]] CloseupSettings closeup_settings(const CloseupKnobs& knobs, bool enabled);

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string_view>

#include "engine/render/knobs/knob_table.h"

namespace gloam {

/// The values are those of shaders/lighting/display/tone_curve.glsl.
enum class ToneCurve : std::uint32_t { filmic, reinhard, linear, agx };
[[nodiscard]] constexpr std::string_view name_of(ToneCurve curve) {
  switch (curve) {
    case ToneCurve::filmic:
      return "filmic";
    case ToneCurve::reinhard:
      return "reinhard";
    case ToneCurve::linear:
      return "linear";
    case ToneCurve::agx:
      return "agx";
  }
  return {};
}

// The knobs that the program does not read; kAntialiasing is in outputs.h.
inline constexpr EnumKnob<ToneCurve> kToneMap{.name = "lighting.tone_map",
                                              .meaning = "tone curve that maps exposed linear light to the picture",
                                              .is_look = true};
/// Entries of the table; 0: no table.
inline constexpr ChoiceKnob<std::uint32_t> kToneMapTable{
    .name = "lighting.tone_map_table",
    .meaning = "entries of the tone curve's lookup table; exact: no table, computed for every pixel",
    .choices = {{"exact", 0}, {"1024", 1024}, {"256", 256}, {"64", 64}}};
inline constexpr OnOffKnob kSpecularAntialiasing{
    .name = "lighting.specular_antialiasing",
    .meaning = "surfaces whose normal changes within a pixel have wider highlights, which do not flicker",
    .choices = {{"on", true}, {"off", false}},
    .default_value = true};
inline constexpr OnOffKnob kDither{
    .name = "lighting.dither",
    .meaning = "rounding of the picture to 8 bits with a fixed pattern, so that gradients show no bands",
    .choices = {{"on", true}, {"off", false}},
    .default_value = true};

}  // namespace gloam

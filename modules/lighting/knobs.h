// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string_view>

#include "engine/render/knobs/knob_table.h"

namespace gloam {

enum class ExposureMode : std::uint8_t { fixed, metered, adapting };
[[nodiscard]] constexpr std::string_view name_of(ExposureMode mode) {
  switch (mode) {
    case ExposureMode::fixed:
      return "fixed";
    case ExposureMode::metered:
      return "metered";
    case ExposureMode::adapting:
      return "adapting";
  }
  return {};
}

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
inline constexpr EnumKnob<ToneCurve> kToneMap{
    .name = "lighting.tone_map",
    .meaning = "tone curve that maps exposed linear light to the picture",
    .taste = "a tone curve is a look; lighting.tone_map_table shows how exactly it is computed"};
/// Entries of the table; 0: no table.
inline constexpr ChoiceKnob<std::uint32_t> kToneMapTable{
    .name = "lighting.tone_map_table",
    .meaning = "entries of the tone curve's lookup table; exact: no table, computed for every pixel",
    .choices = {{"exact", 0}, {"1024", 1024}, {"256", 256}, {"64", 64}}};
/// Read for the whole world: its views agree on whether the scene's exposure counts.
inline constexpr EnumKnob<ExposureMode> kExposure{
    .name = "lighting.exposure",
    .meaning =
        "fixed: the scene's exposure, or one metered in each camera's first frame; metered: in every frame; "
        "adapting: too, but it follows slowly, by half in 0.35 s when it gets brighter and in 1.4 s when darker",
    .taste = "how a camera or an eye follows the light is a look"};
inline constexpr OnOffKnob kSpecularAntialiasing{
    .name = "lighting.specular_antialiasing",
    .meaning = "surfaces whose normal changes within a pixel have wider highlights, which do not flicker",
    .choices = {{"on", true}, {"off", false}},
    .default_value = true};
inline constexpr OnOffKnob kDither{
    .name = "lighting.dither",
    .meaning = "rounding of the picture to 8 bits with a fixed pattern, so that gradients show no bands",
    .choices = {{"on", true}, {"off", false}},
    .default_value = true,
    .taste = "both round to steps of 8 bits: one shows noise of about a step, the other shows bands"};

}  // namespace gloam

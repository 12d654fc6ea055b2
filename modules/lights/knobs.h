// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "engine/render/knobs/knob_table.h"
#include "modules/lights/masks/tile_light_masks.h"
#include "shaders/lights/lights_shared.h"

namespace gloam {

// The knobs that other modules do not read; kLightCulling is in outputs.h.
inline constexpr EnumKnob<TileBound> kLightTileBound{
    .name = "lights.tile_bound",
    .meaning = "shape that bounds a light in the CPU's masks of 32x32-pixel tiles",
    .default_value = TileBound::cone,
    .exact = TileBound::cone,
    .only_with = "lights.culling=tiled"};
inline constexpr ChoiceKnob<std::uint32_t> kLightZBins{
    .name = "lights.z_bins",
    .meaning = "number of depth ranges (zBins) that lights are sorted into",
    .choices = {{"256", 256}, {"512", 512}, {"1024", 1024}, {"2048", 2048}, {"4096", 4096}},
    .default_value = 1024,
    .exact = 4096,
    .unit = "bins",
    .only_with = "lights.culling=tiled"};
inline constexpr IntegerKnob<std::uint32_t> kFixedLightSlots{
    .name = "lights.fixed_slots",
    .meaning =
        "list entries reserved for every shadow tile, which gives lists fixed addresses; 0: as many as a tile needs",
    .max = GLOAM_MAX_LOCAL_LIGHTS,
    .exact = 0,
    .same_picture = true,
    .only_with = "lights.culling=tiled"};
inline constexpr OnOffKnob kEmitterHighlights{
    .name = "lights.emitter_highlights",
    .meaning = "highlights as wide as the light that makes them (on), or as of a point (off)",
    .choices = {{"on", true}, {"off", false}},
    .default_value = true,
    .exact = true};
inline constexpr OnOffKnob kLightCheck{
    .name = "lights.check",
    .meaning =
        "test every light at every pixel, and count lights that are missing in light lists (lights.culling_errors)",
    .exact = false,
    .same_picture = true};

}  // namespace gloam

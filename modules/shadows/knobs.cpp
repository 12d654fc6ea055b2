// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/knobs.h"

#include <utility>

namespace gloam {
namespace {

constexpr std::uint32_t kSmallestAtlas = 1024;  // the first choice; each has twice the side of the one before
constexpr std::uint32_t kSmallestKernel = 4;

Knob choice_knob(std::string name, std::string meaning, std::vector<std::string> choices, std::uint32_t fallback) {
  Knob knob;
  knob.name = "shadows." + std::move(name);
  knob.module = "shadows";
  knob.meaning = std::move(meaning);
  knob.choices = std::move(choices);
  knob.default_number = fallback;
  return knob;
}

Knob number_knob(std::string name, std::string meaning, std::string unit, double max, double fallback) {
  Knob knob = choice_knob(std::move(name), std::move(meaning), {}, 0);
  knob.type = Knob::Type::number;
  knob.unit = std::move(unit);
  knob.max = max;
  knob.default_number = fallback;
  return knob;
}

}  // namespace

void add_shadow_knobs(KnobRegistry& registry) {
  Knob mode = choice_knob(
      "mode",
      "shadows of lights: none, looked up in shadow maps where light is added up, or before that, a light and tile "
      "at a time and only where a tile is neither lit nor unlit as a whole",
      {"off", "monolithic", "deferred"}, 2);
  mode.exact = "monolithic";
  registry.add(mode);
  registry.add(choice_knob("classify",
                           "whether shadow maps are asked about whole tiles before pixels (shadows.mode=deferred)",
                           {"off", "on"}, 1));
  registry.add(
      choice_knob("filter",
                  "how shadow maps are looked up: one texel, a fixed kernel, penumbrae by single fetches, penumbrae by "
                  "gathers from mips",
                  {"hard", "pcf", "pcss", "chs"}, 3));
  Knob kernel = choice_knob("kernel", "side of a filter's kernel", {"4", "8", "12", "16"}, 1);
  kernel.unit = "texels";
  registry.add(kernel);
  registry.add(choice_knob("mips", "whether wide penumbrae are looked up in mips of the maps", {"off", "on"}, 1));
  registry.add(choice_knob("mip_operator",
                           "what a texel of a mip is: the nearest depth of its four, their mean, or the mean of the "
                           "nearest surface with the share of the texel that it covers",
                           {"nearest", "average", "coverage"}, GLOAM_SHADOW_MIPS_COVERAGE));
  registry.add(choice_knob("kernel_shape", "shape of the widest kernel", {"disc", "square"}, 0));
  registry.add(choice_knob("receiver_plane",
                           "compare with the depth of the lit surface's plane, not of the lit point alone",
                           {"off", "on"}, 1));
  registry.add(choice_knob("depth", "how shadow maps hold depth", {"d32", "d16"}, 0));
  registry.add(
      choice_knob("bias",
                  "what keeps a surface from shadowing itself: an offset along the light by the side that it shows, "
                  "or the rasteriser's constant bias",
                  {"hardware", "oriented"}, 1));
  Knob millimetres = number_knob("bias_mm", "offset of bias=oriented", "mm", 20.0, 2.0);
  millimetres.ledger_values = {0.5, 1.0, 2.0, 5.0, 10.0};
  registry.add(millimetres);
  // One unit is 2^-23 of a depth's power of two: between 0.06 and 0.12 µm a metre of distance.
  Knob units = number_knob("bias_units", "constant bias of bias=hardware", "units of depth", 1e6, 2000.0);
  units.ledger_values = {200.0, 1000.0, 2000.0, 10000.0, 50000.0};
  registry.add(units);
  Knob bits = choice_knob("visibility_bits", "steps that a light's visibility at a pixel is rounded to",
                          {"4", "8", "exact"}, 1);
  bits.exact = "exact";
  registry.add(bits);
  Knob atlas = choice_knob("atlas", "side of the image that all shadow maps of a view share",
                           {"1024", "2048", "4096", "8192"}, 2);
  atlas.unit = "texels";
  registry.add(atlas);
  Knob density =
      number_knob("texels_per_pixel", "texels of shadow maps to a pixel's side, as far as the atlas has room",
                  "texels a pixel", 8.0, 3.0);
  density.min = 0.25;
  density.ledger_values = {0.5, 1.0, 2.0, 3.0, 4.0};
  registry.add(density);
  registry.add(choice_knob("casters",
                           "meshes that are drawn into shadow maps: as the camera sees them, or with fewer triangles",
                           {"full", "simplified"}, 0));
  for (const auto& [name, meaning] :
       {std::pair("slot_limit",
                  "slots of visibility that a view may have; tiles that find none are shaded as by monolithic"),
        std::pair("pair_limit", "pairs of a tile and a light whose pixels are asked; likewise")}) {
    Knob limit = number_knob(name, meaning, "", 4194301.0, 4194301.0);
    limit.type = Knob::Type::integer;
    registry.add(limit);
  }
  registry.add(choice_knob("early_outs", "whether a filter ends early where it knows the answer; off: for measuring it",
                           {"off", "on"}, 1));
}

ShadowKnobs shadow_knobs(const KnobRegistry& registry) {
  constexpr std::uint32_t kLevels[] = {15, 255, 0};
  ShadowKnobs knobs;
  knobs.enabled = !registry.is("shadows.mode", "off");
  knobs.filter = registry.choice("shadows.filter");
  knobs.kernel = kSmallestKernel * (registry.choice("shadows.kernel") + 1);
  knobs.mips = registry.is("shadows.mips", "on");
  knobs.mip_operator = registry.choice("shadows.mip_operator");
  knobs.square = registry.is("shadows.kernel_shape", "square");
  knobs.receiver_plane = registry.is("shadows.receiver_plane", "on");
  knobs.d16 = registry.is("shadows.depth", "d16");
  // 16 bits have no room for what a texel leaves free.
  if (knobs.d16 && knobs.mip_operator == GLOAM_SHADOW_MIPS_COVERAGE) knobs.mip_operator = GLOAM_SHADOW_MIPS_NEAREST;
  knobs.oriented = registry.is("shadows.bias", "oriented");
  knobs.bias_m = knobs.oriented ? static_cast<float>(registry.number("shadows.bias_mm") * 1e-3) : 0.0f;
  knobs.bias_units = knobs.oriented ? 0.0f : static_cast<float>(registry.number("shadows.bias_units"));
  knobs.levels = kLevels[registry.choice("shadows.visibility_bits")];
  knobs.atlas_size = kSmallestAtlas << registry.choice("shadows.atlas");
  knobs.texels_per_pixel = static_cast<float>(registry.number("shadows.texels_per_pixel"));
  knobs.simplified = registry.is("shadows.casters", "simplified");
  knobs.early_outs = registry.is("shadows.early_outs", "on");
  knobs.deferred = registry.is("shadows.mode", "deferred");
  knobs.classify = registry.is("shadows.classify", "on");
  knobs.slot_limit = static_cast<std::uint32_t>(registry.number("shadows.slot_limit"));
  knobs.pair_limit = static_cast<std::uint32_t>(registry.number("shadows.pair_limit"));
  return knobs;
}

ShadowSettings shadow_settings(const ShadowKnobs& knobs) {
  ShadowSettings settings;
  settings.enabled = knobs.enabled;
  settings.atlas_size = knobs.atlas_size;
  settings.texels_per_pixel = knobs.texels_per_pixel;
  return settings;
}

std::vector<gpu::SpecConstant> shadow_constants(const ShadowKnobs& knobs, std::uint32_t filter) {
  return {{GLOAM_SHADOWS_FILTER_ID, filter},
          {GLOAM_SHADOWS_KERNEL_ID, knobs.kernel},
          {GLOAM_SHADOWS_MIPS_ID, knobs.mips ? 1u : 0u},
          {GLOAM_SHADOWS_RECEIVER_PLANE_ID, knobs.receiver_plane ? 1u : 0u},
          {GLOAM_SHADOWS_BIAS_ID, knobs.oriented ? 1u : 0u},
          {GLOAM_SHADOWS_KERNEL_SHAPE_ID, knobs.square ? 1u : 0u},
          {GLOAM_SHADOWS_LEVELS_ID, knobs.levels},
          {GLOAM_SHADOWS_FULL_PENUMBRA_ID, knobs.early_outs ? 0u : 1u},
          {GLOAM_SHADOWS_COVERAGE_ID, knobs.mip_operator == GLOAM_SHADOW_MIPS_COVERAGE ? 1u : 0u}};
}

std::string shadow_variant(const std::vector<gpu::SpecConstant>& constants) {
  std::string variant = "shadows";
  for (const gpu::SpecConstant& constant : constants) variant += "-" + std::to_string(constant.value);
  return variant;
}

}  // namespace gloam

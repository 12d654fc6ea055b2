// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/knobs.h"

#include <utility>

namespace gloam {
namespace {

constexpr std::uint32_t kSmallestAtlas = 1024;  // the first choice; each further choice doubles the side
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
      "when shadows are computed: never; during shading, for each pixel and light (monolithic); or before shading, for "
      "each pair of an 8x8 tile and a light that is neither wholly lit nor wholly unlit (deferred)",
      {"off", "monolithic", "deferred"}, 2);
  mode.exact = "monolithic";
  registry.add(mode);
  registry.add(choice_knob("classify",
                           "test whole tiles against shadow maps first, and filter only the pixels of undecided tiles "
                           "(shadows.mode=deferred)",
                           {"off", "on"}, 1));
  registry.add(choice_knob(
      "filter",
      "shadow filter: one texel (hard), a kernel of fixed width (pcf), penumbrae from single fetches (pcss), "
      "or penumbrae from gathers in two mips (chs, contact hardening)",
      {"hard", "pcf", "pcss", "chs"}, 3));
  Knob kernel = choice_knob("kernel", "width of the filter kernel", {"4", "8", "12", "16"}, 1);
  kernel.unit = "texels";
  registry.add(kernel);
  Knob near = choice_knob(
      "near",
      "where blockers are about as near to a lamp as it is wide, project them onto the lamp in place of one kernel "
      "(shadows.filter=chs): never; only where the lamp sees them far off the receiver's direction; or always",
      {"off", "wide", "all"}, 1);
  near.exact = "all";
  registry.add(near);
  registry.add(choice_knob("mips", "filter wide penumbrae in mips of the shadow maps", {"off", "on"}, 1));
  registry.add(
      choice_knob("mip_operator",
                  "how four texels become one texel of the next mip: their nearest depth, their mean depth, or "
                  "the mean depth of the nearest surface with the share of the texel that it covers",
                  {"nearest", "average", "coverage"}, GLOAM_SHADOW_MIPS_COVERAGE));
  registry.add(choice_knob("kernel_shape", "shape of the kernel for the widest penumbrae", {"disc", "square"}, 0));
  registry.add(choice_knob("receiver_plane",
                           "compare each texel of the kernel with the plane of the receiving surface, not with the "
                           "receiver's depth",
                           {"off", "on"}, 1));
  registry.add(choice_knob("terminator",
                           "on smooth-shaded meshes, judge shadows from the smooth surface that the vertex normals "
                           "describe, so that shadow edges do not follow facets",
                           {"off", "on"}, 0));
  registry.add(choice_knob("depth", "depth format of shadow maps: 32-bit float, or 16-bit integer", {"d32", "d16"}, 0));
  registry.add(choice_knob(
      "bias",
      "depth bias against self-shadowing: the rasteriser's constant bias (hardware), or an offset toward or "
      "away from the light, depending on which side of the surface faces it (oriented)",
      {"hardware", "oriented"}, 1));
  Knob millimetres = number_knob("bias_mm", "depth offset of shadows.bias=oriented", "mm", 20.0, 2.0);
  millimetres.ledger_values = {0.5, 1.0, 2.0, 5.0, 10.0};
  registry.add(millimetres);
  // One unit is 2^-23 of the depth's power of two: 0.06 to 0.12 µm per metre of distance.
  Knob units = number_knob("bias_units", "constant depth bias of shadows.bias=hardware", "units of depth", 1e6, 2000.0);
  units.ledger_values = {200.0, 1000.0, 2000.0, 10000.0, 50000.0};
  registry.add(units);
  Knob bits =
      choice_knob("visibility_bits", "bits of a stored visibility, for each pixel and light; exact: not rounded",
                  {"4", "8", "exact"}, 1);
  bits.exact = "exact";
  registry.add(bits);
  Knob atlas = choice_knob("atlas", "side of the atlas, the image that holds all shadow maps of a view",
                           {"1024", "2048", "4096", "8192"}, 2);
  atlas.unit = "texels";
  registry.add(atlas);
  Knob density = number_knob("texels_per_pixel", "shadow-map texels along a pixel's side; fewer if the atlas is full",
                             "texels a pixel", 8.0, 3.0);
  density.min = 0.25;
  density.ledger_values = {0.5, 1.0, 2.0, 3.0, 4.0};
  registry.add(density);
  registry.add(choice_knob("casters", "triangles drawn into shadow maps: all of them, or a simplified mesh with fewer",
                           {"full", "simplified"}, 0));
  for (const auto& [name, meaning] :
       {std::pair(
            "slot_limit",
            "most visibility slots of a view; tiles without a free slot are shaded as with shadows.mode=monolithic"),
        std::pair("pair_limit",
                  "most tile-light pairs of a view; tiles whose pairs do not fit are shaded as with "
                  "shadows.mode=monolithic")}) {
    Knob limit = number_knob(name, meaning, "", 4194301.0, 4194301.0);
    limit.type = Knob::Type::integer;
    registry.add(limit);
  }
  registry.add(choice_knob("early_outs",
                           "stop filtering as soon as the result is known; off: only to measure the whole filter",
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
  knobs.terminator = registry.is("shadows.terminator", "on");
  knobs.d16 = registry.is("shadows.depth", "d16");
  // 16-bit depths have no spare bits for coverage.
  if (knobs.d16 && knobs.mip_operator == GLOAM_SHADOW_MIPS_COVERAGE) knobs.mip_operator = GLOAM_SHADOW_MIPS_NEAREST;
  knobs.oriented = registry.is("shadows.bias", "oriented");
  knobs.bias_m = knobs.oriented ? static_cast<float>(registry.number("shadows.bias_mm") * 1e-3) : 0.0f;
  knobs.bias_units = knobs.oriented ? 0.0f : static_cast<float>(registry.number("shadows.bias_units"));
  knobs.levels = kLevels[registry.choice("shadows.visibility_bits")];
  knobs.atlas_size = kSmallestAtlas << registry.choice("shadows.atlas");
  knobs.texels_per_pixel = static_cast<float>(registry.number("shadows.texels_per_pixel"));
  knobs.simplified = registry.is("shadows.casters", "simplified");
  knobs.near = registry.choice("shadows.near");
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

gpu::SpecConstants shadow_constants(const ShadowKnobs& knobs, std::uint32_t filter) {
  gpu::SpecConstants constants;
  constants.set_if_present("kFilter", filter);
  constants.set_if_present("kKernel", static_cast<std::int32_t>(knobs.kernel));
  constants.set_if_present("kMips", knobs.mips ? 1u : 0u);
  constants.set_if_present("kReceiverPlane", knobs.receiver_plane ? 1u : 0u);
  constants.set_if_present("kBias", knobs.oriented ? 1u : 0u);
  constants.set_if_present("kKernelShape", knobs.square ? 1u : 0u);
  constants.set_if_present("kLevels", knobs.levels);
  constants.set_if_present("kFullPenumbra", knobs.early_outs ? 0u : 1u);
  constants.set_if_present("kCoverage", knobs.mip_operator == GLOAM_SHADOW_MIPS_COVERAGE ? 1u : 0u);
  constants.set_if_present("kNear", knobs.near);
  constants.set_if_present("kTerminator", knobs.terminator ? 1u : 0u);
  return constants;
}

}  // namespace gloam

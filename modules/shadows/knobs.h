// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "engine/gpu/types.h"
#include "engine/render/knobs/knob_table.h"
#include "modules/shadows/outputs.h"
#include "shaders/shadows/shadows_shared.h"

namespace gloam {

// Values of kFilter (shadows_api.glsl).
inline constexpr std::uint32_t kSingleFetches = 2;
inline constexpr std::uint32_t kContactHardening = 3;
inline constexpr std::uint32_t kTracedShadows = 4;
inline constexpr std::uint32_t kNoShadows = 5;  ///< no shadows, cookies only

// The knobs that only this module reads; the others are in outputs.h.
inline constexpr OnOffKnob kShadowClassify{
    .name = "shadows.classify",
    .meaning =
        "test whole tiles against shadow maps first, and filter only the pixels of undecided tiles "
        "(shadows.mode=deferred)",
    .default_value = true,
    .only_with = "shadows.mode=deferred"};
/// Values of kFilter (shadows_api.glsl).
inline constexpr ChoiceKnob<std::uint32_t> kShadowFilter{
    .name = "shadows.filter",
    .meaning =
        "shadow filter: one texel (hard), a kernel of fixed width (pcf), penumbrae from single fetches (pcss), "
        "or penumbrae from gathers in two mips (chs, contact hardening)",
    .choices = {{"hard", 0}, {"pcf", 1}, {"pcss", kSingleFetches}, {"chs", kContactHardening}},
    .default_value = kContactHardening,
    .only_with = "shadows.mode=monolithic|deferred"};
inline constexpr ChoiceKnob<std::uint32_t> kShadowKernel{.name = "shadows.kernel",
                                                         .meaning = "width of the filter kernel",
                                                         .choices = {{"4", 4}, {"8", 8}, {"12", 12}, {"16", 16}},
                                                         .default_value = 8,
                                                         .unit = "texels",
                                                         .only_with = "shadows.filter=pcf|pcss|chs"};
/// Values of kShadowNear.
inline constexpr ChoiceKnob<std::uint32_t> kShadowNear{
    .name = "shadows.near",
    .meaning =
        "where blockers are about as near to a lamp as it is wide, project them onto the lamp in place of one "
        "kernel (shadows.filter=chs): never; only where the lamp sees them far off the receiver's direction; "
        "or always",
    .choices = {{"off", 0}, {"wide", 1}, {"all", 2}},
    .default_value = 1,
    .only_with = "shadows.filter=chs"};
inline constexpr ChoiceKnob<std::uint32_t> kShadowNearDirections{
    .name = "shadows.near_directions",
    .meaning = "directions around the receiver's in which shadows.near looks for blockers",
    .choices = {{"8", 8}, {"16", 16}, {"32", 32}},
    .default_value = 16,
    .unit = "directions",
    .only_with = "shadows.near=wide|all"};
inline constexpr OnOffKnob kShadowMips{.name = "shadows.mips",
                                       .meaning = "filter wide penumbrae in mips of the shadow maps",
                                       .default_value = true,
                                       .only_with = "shadows.mode=monolithic|deferred"};
inline constexpr ChoiceKnob<std::uint32_t> kShadowMipOperator{
    .name = "shadows.mip_operator",
    .meaning =
        "how four texels become one texel of the next mip: their nearest depth, their mean depth, or "
        "the mean depth of the nearest surface with the share of the texel that it covers",
    .choices = {{"nearest", GLOAM_SHADOW_MIPS_NEAREST},
                {"average", GLOAM_SHADOW_MIPS_AVERAGE},
                {"coverage", GLOAM_SHADOW_MIPS_COVERAGE}},
    .default_value = GLOAM_SHADOW_MIPS_COVERAGE,
    .only_with = "shadows.mips=on"};
inline constexpr ChoiceKnob<bool> kSquareShadowKernel{.name = "shadows.kernel_shape",
                                                      .meaning = "shape of the kernel for the widest penumbrae",
                                                      .choices = {{"disc", false}, {"square", true}},
                                                      .only_with = "shadows.filter=chs"};
inline constexpr OnOffKnob kShadowReceiverPlane{
    .name = "shadows.receiver_plane",
    .meaning =
        "compare each texel of the kernel with the plane of the receiving surface, not with the receiver's depth",
    .default_value = true,
    .only_with = "shadows.mode=monolithic|deferred"};
inline constexpr OnOffKnob kShadowTerminator{
    .name = "shadows.terminator",
    .meaning =
        "on smooth-shaded meshes, judge shadows from the smooth surface that the vertex normals describe, so "
        "that shadow edges do not follow facets",
    .only_with = "shadows.mode=monolithic|deferred"};
inline constexpr ChoiceKnob<bool> kShadowDepth16{
    .name = "shadows.depth",
    .meaning = "depth format of shadow maps: 32-bit float, or 16-bit integer",
    .choices = {{"d32", false}, {"d16", true}},
    .only_with = "shadows.mode=monolithic|deferred"};
inline constexpr ChoiceKnob<bool> kOrientedShadowBias{
    .name = "shadows.bias",
    .meaning =
        "depth bias against self-shadowing: the rasteriser's constant bias (hardware), or an offset toward or "
        "away from the light, depending on which side of the surface faces it (oriented)",
    .choices = {{"hardware", false}, {"oriented", true}},
    .default_value = true,
    .only_with = "shadows.mode=monolithic|deferred"};
/// Values of kSubsurfaceBias (shadows_api.glsl) are 4 and 1.
inline constexpr ChoiceKnob<bool> kSubsurfaceBacks{
    .name = "shadows.subsurface",
    .meaning =
        "how bodies with a subsurface material are kept from shadowing themselves where they are thin: drawn whole, "
        "with four times the bias (larger_bias: 8 mm, 1.6 extinction lengths of 5 mm, beyond which less than 20 % of "
        "the light comes through), or without the faces toward the light and with the usual bias, because no other "
        "face of the body is nearer than its lit side (back_faces); the map then holds no thickness: all of "
        "a body lets light through as a sheet does",
    .choices = {{"larger_bias", false}, {"back_faces", true}},
    .only_with = "shadows.mode=monolithic|deferred"};
inline constexpr NumberKnob kShadowBiasMm{.name = "shadows.bias_mm",
                                          .meaning = "depth offset of shadows.bias=oriented",
                                          .max = 20.0,
                                          .default_value = 2.0,
                                          .unit = "mm",
                                          .ledger_values = {0.5, 1.0, 2.0, 5.0, 10.0},
                                          .only_with = "shadows.bias=oriented"};
/// One unit is 2^-23 of the depth's power of two: 0.06 to 0.12 µm per metre of distance.
inline constexpr NumberKnob kShadowBiasUnits{.name = "shadows.bias_units",
                                             .meaning = "constant depth bias of shadows.bias=hardware",
                                             .max = 1e6,
                                             .default_value = 2000.0,
                                             .unit = "units of depth",
                                             .ledger_values = {200.0, 1000.0, 2000.0, 10000.0, 50000.0},
                                             .only_with = "shadows.bias=hardware"};
/// Steps of a visibility; 0: it is not rounded.
inline constexpr ChoiceKnob<std::uint32_t> kVisibilityLevels{
    .name = "shadows.visibility_bits",
    .meaning = "bits of a stored visibility, for each pixel and light; exact: not rounded",
    .choices = {{"4", 15}, {"8", 255}, {"exact", 0}},
    .default_value = 255,
    .only_with = "shadows.mode=deferred"};
inline constexpr ChoiceKnob<std::uint32_t> kShadowAtlas{
    .name = "shadows.atlas",
    .meaning = "side of the atlas, the image that holds all shadow maps of a view",
    .choices = {{"1024", 1024}, {"2048", 2048}, {"4096", 4096}, {"8192", 8192}},
    .default_value = 4096,
    .unit = "texels",
    .only_with = "shadows.mode=monolithic|deferred"};
inline constexpr IntegerKnob<std::uint32_t> kShadowKeptAtlases{
    .name = "shadows.kept_atlases",
    .meaning =
        "memory for views whose shadow maps stay from frame to frame; further views take turns in one atlas, where "
        "each "
        "draws its maps again if another view has drawn since",
    .max = 65536,
    .default_value = 384,
    .unit = "MiB",
    .only_with = "shadows.mode=monolithic|deferred"};
inline constexpr NumberKnob kShadowTexelsPerPixel{
    .name = "shadows.texels_per_pixel",
    .meaning = "shadow-map texels along a pixel's side; fewer if the atlas is full",
    .min = 0.25,
    .max = 8.0,
    .default_value = 3.0,
    .unit = "texels a pixel",
    .ledger_values = {0.5, 1.0, 2.0, 3.0, 4.0},
    .only_with = "shadows.mode=monolithic|deferred"};
inline constexpr ChoiceKnob<bool> kSimplifiedCasters{
    .name = "shadows.casters",
    .meaning = "triangles drawn into shadow maps: all of them, or a simplified mesh with fewer",
    .choices = {{"full", false}, {"simplified", true}},
    .only_with = "shadows.mode=monolithic|deferred"};
inline constexpr NumberKnob kShadowLodTexels{
    .name = "shadows.lod_texels",
    .meaning =
        "greatest distance between the triangles drawn into a shadow map and all triangles of a caster, in texels; for "
        "scenes of more than 131,072 triangles; 0: all triangles are drawn",
    .max = 2.0,
    .default_value = 0.5,
    .unit = "texels",
    .ledger_values = {0.0, 0.125, 0.25, 0.5, 1.0},
    .only_with = "shadows.mode=monolithic|deferred"};
inline constexpr std::uint32_t kMostSlotsAndPairs = 4194301;
inline constexpr IntegerKnob<std::uint32_t> kShadowSlotLimit{
    .name = "shadows.slot_limit",
    .meaning = "most visibility slots of a view; tiles without a free slot are shaded as with shadows.mode=monolithic",
    .max = kMostSlotsAndPairs,
    .default_value = kMostSlotsAndPairs,
    .only_with = "shadows.mode=deferred"};
inline constexpr IntegerKnob<std::uint32_t> kShadowPairLimit{
    .name = "shadows.pair_limit",
    .meaning =
        "most tile-light pairs of a view; tiles whose pairs do not fit are shaded as with "
        "shadows.mode=monolithic",
    .max = kMostSlotsAndPairs,
    .default_value = kMostSlotsAndPairs,
    .only_with = "shadows.mode=deferred"};
inline constexpr OnOffKnob kShadowEarlyOuts{
    .name = "shadows.early_outs",
    .meaning = "stop filtering as soon as the result is known; off: only to measure the whole filter",
    .default_value = true,
    .only_with = "shadows.filter=pcf|pcss|chs"};

inline constexpr NumberKnob kShadowMinContribution{
    .name = "shadows.min_contribution",
    .meaning =
        "a local light that can add at most this to any pixel of a tile gets the mean visibility of eight of the "
        "tile's pixels; all such lights of a tile add at most four times this; only with a fixed exposure",
    .max = 1.0 / 64.0,
    .default_value = 0.0,
    .unit = "of white before the tone curve",
    .ledger_values = {0.0, 1.0 / 1024.0, 1.0 / 512.0, 1.0 / 256.0},
    .only_with = "shadows.mode=deferred"};

/// The module's knobs as numbers (shadows.NAME, see add_shadow_knobs).
struct ShadowKnobs {
  bool enabled = true;
  bool deferred = true;            ///< final lists are made
  bool classify = true;            ///< tiles are classified before pixels are filtered
  std::uint32_t slot_limit = ~0u;  ///< greatest number of visibility slots per view
  std::uint32_t pair_limit = ~0u;  ///< greatest number of tile-light pairs per view
  std::uint32_t filter = 3;        ///< value of kFilter (shadows_api.glsl)
  std::uint32_t kernel = 8;        ///< texels of the kernel's side
  bool mips = true;
  std::uint32_t mip_operator = GLOAM_SHADOW_MIPS_COVERAGE;  ///< GLOAM_SHADOW_MIPS_…; with d16 never coverage
  bool square = false;                                      ///< the widest kernel is a square, not a disc
  bool receiver_plane = true;  ///< taps are compared with the receiver plane, not with the receiver's depth
  bool d16 = false;            ///< the atlas is r16_unorm, else r32f
  bool oriented = true;        ///< oriented bias, else the rasteriser's
  float bias_m = 0.002f;       ///< oriented bias in metres; 0 with hardware bias
  float bias_units = 0.0f;  ///< constant depth bias of map draws, away from the light, in steps of the depth format; 0
                            ///< with oriented bias
  std::uint32_t levels = 255;  ///< steps of a visibility: 15 or 255; 0: not quantised
  std::uint32_t atlas_size = 4096;
  std::uint64_t kept_atlas_bytes = ~0ull;  ///< of the images of views that do not take turns
  float texels_per_pixel = 3.0f;
  bool simplified = false;  ///< casters are drawn with their simplified triangles
  float lod_texels = 0.0f;  ///< greatest error of casters' levels of detail; 0: there are none
  std::uint32_t near = 1;   ///< estimate of near blockers: 0 off, 1 wide, 2 all
  std::uint32_t near_directions = 16;
  bool terminator = false;                 ///< smooth-shaded surfaces are judged at their smooth surface
  bool subsurface_backs = false;           ///< closed bodies that light passes through are drawn without their lit side
  bool transmission = false;               ///< the scene has materials that light passes through
  std::uint32_t thin_filter = 0;           ///< value of kThinFilter (shadows_api.glsl)
  ShadowReuse reuse = ShadowReuse::exact;  ///< visibilities of the last frame that are kept
  float min_contribution = 0.0f;           ///< of white before the tone curve; 0: no light is dim
  bool early_outs = true;  ///< a filter stops as soon as the result is known; false only for measurements
};

/// The knobs that systems read; a view resource.
struct ShadowSettings {
  bool enabled = true;              ///< shadows.mode is not off
  std::uint32_t atlas_size = 4096;  ///< texels, a power of two
  bool d16 = false;                 ///< maps have 16 bits
  std::uint32_t cascades = 4;       ///< cascades of a directional light, at most GLOAM_MAX_CASCADES
  float kernel_rim = 0.125f;        ///< width of a rim as a share of the half extent inside it; see rim_share()
  float texels_per_pixel = 3.0f;    ///< wanted shadow-map texels along a pixel's side; lowered until the maps fit
  bool operator==(const ShadowSettings&) const = default;
};

void add_shadow_knobs(KnobRegistry& registry);
[[nodiscard]] ShadowKnobs shadow_knobs(const KnobRegistry& registry);
[[nodiscard]] ShadowSettings shadow_settings(const ShadowKnobs& knobs);

/// Specialisation constants of the knobs, for shaders that include shadows_api.glsl. filter: value of kFilter.
[[nodiscard]] gpu::SpecConstants shadow_constants(const ShadowKnobs& knobs, std::uint32_t filter);

}  // namespace gloam

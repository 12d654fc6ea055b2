// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string_view>

#include "engine/render/knobs/knob_table.h"
#include "modules/reflections/captures.h"
#include "modules/reflections/culling/tiles.h"
#include "modules/reflections/module.h"

namespace gloam {

/// The tiers above probes.
struct ReflectionTiers {
  bool screen_space = true;  ///< tier 1
  bool proxies = true;       ///< tier 2
  bool operator==(const ReflectionTiers&) const = default;
};

/// Current values of the module's knobs.
struct ReflectionKnobs {
  enum class Mode : std::uint8_t { tiers, planar, off };
  [[nodiscard]] friend constexpr std::string_view name_of(Mode mode) {
    switch (mode) {
      case Mode::tiers:
        return "tiers";
      case Mode::planar:
        return "planar";
      case Mode::off:
        return "off";
    }
    return {};
  }
  Mode mode = Mode::tiers;
  bool screen_space = true;  ///< tier 1
  bool proxies = true;       ///< tier 2
  bool temporal = false;
  bool pixel_roughness = true;
  bool blur = true;
  bool dilation = true;
  bool bump = true;
  bool pixel_normals = false;  ///< rays of screen space and proxies follow the normals of pixels, not the vertical
  bool light_scale = true;
  float k1 = 0.0f;
  float k2 = 0.0f;
  float reach_m = 0.0f;
  std::uint32_t refine = 0;
  bool full_resolution = false;
  bool hierarchical = false;
  ProxyTileSettings tiles;
  std::uint32_t layers = 4;
  bool sort = true;
  bool sphere_test = true;
  bool naive = false;
  bool recapture = false;

  /// Whether reflection images are drawn, for either of the first two tiers.
  [[nodiscard]] bool mirror() const { return screen_space || proxies; }
  /// Whether the composite bends its lookups by the normals of pixels: their rays have not followed these.
  [[nodiscard]] bool bends() const { return bump && !pixel_normals; }
  [[nodiscard]] std::uint32_t scale() const { return full_resolution ? 1 : 2; }
};

inline constexpr EnumKnob<ReflectionKnobs::Mode> kReflectionMode{
    .name = "reflections.mode",
    .meaning =
        "reflections by tiers, each the fallback of the one before (tiers), by drawing the scene mirrored at one "
        "plane (planar), or of the sky alone (off)"};
inline constexpr ChoiceKnob<ReflectionTiers> kReflectionTiers{
    .name = "reflections.tiers",
    .meaning = "tiers of reflections: screen space (ssr), image-based proxies (ibr), probes (cube)",
    .choices = {{"cube", {false, false}},
                {"ssr+cube", {true, false}},
                {"ibr+cube", {false, true}},
                {"all", {true, true}}},
    .default_value = {true, true},
    .only_with = "reflections.mode=tiers"};
inline constexpr OnOffKnob kReflectionTemporal{
    .name = "reflections.temporal",
    .meaning = "whether reflections are accumulated over frames, reprojected by the mirrored position",
    .only_with = "reflections.mode=tiers|planar"};
inline constexpr ChoiceKnob<bool> kReflectionPixelRoughness{
    .name = "reflections.roughness",
    .meaning =
        "width of the blur of reflections: one for all surfaces, as in the paper (constant), or by each "
        "surface's roughness (pixel)",
    .choices = {{"constant", false}, {"pixel", true}},
    .default_value = true,
    .only_with = "reflections.mode=tiers|planar"};
inline constexpr OnOffKnob kReflectionBlur{
    .name = "reflections.blur",
    .meaning = "whether reflections are blurred by the distance of what they show",
    .default_value = true,
    .only_with = "reflections.mode=tiers|planar"};
inline constexpr OnOffKnob kReflectionDilation{
    .name = "reflections.dilation",
    .meaning =
        "whether blurred things have blurred silhouettes: the blur of a pixel is as wide as that of any pixel whose "
        "blur reaches it",
    .default_value = true,
    .only_with = "reflections.blur=on"};
inline constexpr OnOffKnob kReflectionBump{
    .name = "reflections.bump",
    .meaning = "whether the lookup of a pixel's reflection is bent by its normal, where rays have followed another one",
    .default_value = true,
    .only_with = "reflections.normal=up"};
inline constexpr ChoiceKnob<bool> kReflectionPixelNormals{
    .name = "reflections.normal",
    .meaning =
        "normal of surfaces for the rays of screen space and proxies: straight up, as in the paper (up), or that of "
        "each pixel, which tests all proxies as ibr.loop=naive and needs no reflections.bump (pixel)",
    .choices = {{"up", false}, {"pixel", true}},
    .only_with = "reflections.mode=tiers|planar"};
inline constexpr OnOffKnob kReflectionLightScale{
    .name = "reflections.light_scale",
    .meaning = "whether captured colours follow lights that have changed since the capture",
    .default_value = true,
    .only_with = "reflections.mode=tiers|planar"};

inline constexpr NumberKnob kSsrK1{
    .name = "ssr.k1",
    .meaning = "samples of the constant march near the camera: max(1, k1 · exp(−k2 · depth))",
    .min = 1,
    .max = 256,
    .default_value = 32,
    .unit = "samples",
    .ledger_values = {8, 16, 32, 64},
    .only_with = "ssr.march=constant"};
inline constexpr NumberKnob kSsrK2{.name = "ssr.k2",
                                   .meaning = "how fast that number falls with depth",
                                   .max = 1,
                                   .default_value = 0.02,
                                   .unit = "1/m",
                                   .ledger_values = {0, 0.02, 0.05, 0.1},
                                   .only_with = "ssr.march=constant"};
inline constexpr NumberKnob kSsrReach{
    .name = "ssr.reach",
    .meaning =
        "height above the reflecting surface up to which rays are followed; proxies and probes show what is "
        "higher",
    .min = 0.1,
    .max = 1000,
    .default_value = 8,
    .unit = "m",
    .ledger_values = {1, 1.8, 4, 8, 16},
    .only_with = "reflections.tiers=ssr+cube|all"};
inline constexpr IntegerKnob<std::uint32_t> kSsrRefine{.name = "ssr.refine",
                                                       .meaning = "steps of the binary search for the hit",
                                                       .max = 16,
                                                       .default_value = 5,
                                                       .unit = "steps",
                                                       .ledger_values = {0, 2, 4, 5, 6},
                                                       .only_with = "reflections.tiers=ssr+cube|all"};
inline constexpr ChoiceKnob<bool> kSsrFullResolution{
    .name = "ssr.resolution",
    .meaning = "size of the reflection images, relative to the picture",
    .choices = {{"half", false}, {"full", true}},
    .only_with = "reflections.mode=tiers|planar"};
inline constexpr ChoiceKnob<bool> kSsrHierarchical{
    .name = "ssr.march",
    .meaning =
        "steps of the screen-space march: constant in metres, or by tiles of the depth image and pixels where a "
        "tile holds something near the ray (hierarchical)",
    .choices = {{"constant", false}, {"hierarchical", true}},
    .default_value = true,
    .only_with = "reflections.tiers=ssr+cube|all"};

inline constexpr ChoiceKnob<std::uint32_t> kProxyTiles{
    .name = "ibr.tiles",
    .meaning = "vertical screen tiles with a list of proxies each",
    .choices = {{"1", 1}, {"4", 4}, {"8", 8}, {"16", 16}, {"32", 32}, {"64", 64}},
    .default_value = 16,
    .same_picture = true,
    .only_with = "ibr.loop=tiles"};
inline constexpr EnumKnob<ProxyTileBound> kProxyTileBound{
    .name = "ibr.tile_bound",
    .meaning = "screen range of a reflected proxy: exact, or by the heuristic of the paper, which can miss hits",
    .exact = ProxyTileBound::exact,
    .only_with = "ibr.loop=tiles"};
inline constexpr IntegerKnob<std::uint32_t> kProxyLayers{
    .name = "ibr.layers",
    .meaning = "nearest layers along a reflected ray that are blended",
    .min = 1,
    .max = 4,
    .default_value = 4,
    .unit = "layers",
    .ledger_values = {1, 2, 3, 4},
    .only_with = "reflections.tiers=ibr+cube|all"};
inline constexpr OnOffKnob kProxySort{
    .name = "ibr.sort",
    .meaning =
        "whether layers along a reflected ray are sorted by distance (on), or blended in the order in which they are "
        "tested, what screen space has met first (off)",
    .default_value = true,
    .only_with = "reflections.tiers=ibr+cube|all"};
inline constexpr OnOffKnob kProxySphereTest{
    .name = "ibr.sphere_test",
    .meaning = "whether a proxy's bounding sphere is tested before its rectangle",
    .default_value = true,
    .same_picture = true,
    .only_with = "reflections.tiers=ibr+cube|all"};
inline constexpr ChoiceKnob<bool> kNaiveProxyLoop{
    .name = "ibr.loop",
    .meaning = "proxies that a pixel tests: those of its tile (tiles), or all of the world (naive)",
    .choices = {{"tiles", false}, {"naive", true}},
    .exact = true,
    .same_picture = true,
    .only_with = "reflections.tiers=ibr+cube|all"};

inline constexpr EnumKnob<IndirectSource> kIndirectLight{
    .name = "lighting.indirect",
    .meaning =
        "light that surfaces get from their surroundings: that of sky and ground, seen from everywhere (sky), or that "
        "of lit surfaces and the sky as the scene's cube probes see them, with sky and ground beyond the probes "
        "(probes)"};

void add_reflection_knobs(KnobRegistry& registry);
[[nodiscard]] ReflectionKnobs reflection_knobs(const KnobRegistry& registry);

}  // namespace gloam

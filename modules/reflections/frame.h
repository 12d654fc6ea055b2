// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// Data of one view's reflections, in the order in which a frame makes them.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/frame/frame_graph.h"
#include "engine/gpu/types.h"
#include "engine/render/view.h"
#include "modules/reflections/knobs.h"
#include "modules/reflections/override.h"
#include "shaders/reflections/reflections_shared.h"

namespace gloam {

/// The plane that a view is mirrored at, with reflections.mode=planar. A resource of the view.
struct PlanarMirror {
  double height_m = 0.0;  ///< world
  double slack_m = 0.0;   ///< surfaces at most this far from it show the mirrored picture
  ViewId view{0};         ///< the companion that draws the mirrored scene
};

/// Which reflections a frame draws, and from which rows. On the board from PassPhase::announce on.
struct ReflectionPlan {
  ReflectionKnobs knobs;
  bool mirror = false;                       ///< mirror surfaces get a reflection: tiers 1 and 2, or `planar`
  shaders::ReflectionConstants constants{};  ///< without fog
  std::vector<shaders::ProxyRow> proxies;
  std::vector<vec4> factors;                  ///< of captured light (changed_light_api.glsl); ProxyRow::factor
  bool no_specular = false;                   ///< for references: nothing is added (ReflectionOverride)
  const TracedReflections* traced = nullptr;  ///< for references: takes the place of all tiers
  std::optional<PlanarMirror> planar;         ///< takes the place of tiers 1 and 2
};

/// Constants that all passes of a view read.
struct ReflectionUniforms {
  shaders::ReflectionConstants constants{};
  gpu::Binding::BufferRange block;  ///< `constants`
  gpu::Binding::BufferRange tiles;  ///< ProxyTileConstants
};

/// Proxies that rays of the view may meet.
struct ProxyInputs {
  std::span<const shaders::ProxyRow> rows;
  std::span<const std::uint32_t> masks;  ///< ProxyTiles::masks
  std::span<const vec4> factors;         ///< ReflectionPlan::factors
  ImageRef images;                       ///< captures, one layer each; null: none
};

/// Tiles of GLOAM_REFLECTION_GROUP texels' side, and those among them that hold a mirror surface.
struct MirrorTiles {
  ImageRef image;      ///< rg32ui, of all texels: mirror_surface_api.glsl
  BufferRef commands;  ///< MirrorCommands of each GLOAM_LIST_…
  BufferRef places;    ///< the tiles of each list, x | y << 16
  BufferRef flags;     ///< of every tile: GLOAM_TILE_… bits
  shaders::MirrorLists lists{};
  BufferRef roughness;      ///< of every tile: 1…255; 0: without a mirror surface
  std::uint32_t count = 0;  ///< of all tiles
};

/// Surfaces that tiers 1 and 2 serve.
struct MirrorSurfaces {
  MirrorTiles tiles;
  ImageRef surface;  ///< rgba8, cleared in all texels: MirroredLight::surface is written on it
};

/// Specular ambient light of surfaces that reflect strongly, in tiles of GLOAM_LIST_STRONG: rgba16f of the view's size.
/// Alpha is mirror_share(); where it is above 0, rgb is the part that mirrored images take the place of, and the lit
/// picture does not have it yet. 0 for other surfaces. On the board in PassPhase::shading.
struct StrongAmbient {
  ImageRef light;
};

/// Tier 1; null images without it.
struct ScreenSpaceHits {
  ImageRef color;     ///< rgba16f: radiance and confidence
  ImageRef distance;  ///< rgba8: packed distance in xy; z: 1 if the color holds blended surfaces
};

/// Light that mirror surfaces reflect.
struct MirroredLight {
  ImageRef color;    ///< rgba16f: premultiplied radiance and confidence of tiers 1 and 2
  ImageRef surface;  ///< rgba8: spread, roughness (0: no reflection), packed distance in zw
};

/// Handles that visualizers and picking read. On the board after PassPhase::shading. The images of `hits` and `light`
/// are null when no visible material is smooth enough for them.
struct ReflectionHandles {
  ReflectionUniforms uniforms;
  ScreenSpaceHits hits;
  MirroredLight light;
  ImageRef mirrors;  ///< MirrorTiles::image
};

}  // namespace gloam

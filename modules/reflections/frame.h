// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
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

/// A view's reflections, on the board from PassPhase::announce on; images from PassPhase::shading on. Images of the
/// first two tiers are null when no visible material is smooth enough for them.
struct ReflectionFrame {
  ReflectionKnobs knobs;
  bool mirror = false;  ///< screen space or proxies are drawn
  shaders::ReflectionConstants constants{};
  gpu::Binding::BufferRange block;  ///< ReflectionConstants
  gpu::Binding::BufferRange tiles;  ///< ProxyTileConstants
  std::vector<shaders::ProxyRow> proxies;
  std::vector<shaders::ProbeRow> probes;
  std::vector<shaders::ChangedLight> changed;
  bool no_specular = false;                   ///< for references: nothing is added (ReflectionOverride)
  const TracedReflections* traced = nullptr;  ///< for references: takes the place of all tiers
  ImageRef traced_image;                      ///< rgba32f, of the view's size
  std::optional<PlanarMirror> planar;         ///< takes the place of the first two tiers
  ImageRef proxy_images;
  ImageRef probe_images;
  std::uint32_t tile_count = 0;  ///< of GLOAM_REFLECTION_GROUP texels' side
  BufferRef commands;            ///< MirrorCommands
  BufferRef places;              ///< the listed tiles, x | y << 16
  BufferRef tile_roughness;      ///< of every tile: 1…255; 0: without a mirror surface
  ImageRef mirror_image;         ///< rg32ui: mirror_surface_api.glsl
  ImageRef upscaled;             ///< rgba16f of the view's size: `color` with bent lookup, sharp hits and fog
  ImageRef ssr_color;            ///< rgba16f: radiance and confidence of tier 1
  ImageRef ssr_distance;         ///< rgba8: packed distance in xy
  ImageRef color;                ///< rgba16f: premultiplied radiance and confidence of tiers 1 and 2
  ImageRef surface;              ///< rgba8: spread, roughness (0: no reflection), packed distance in zw
};

}  // namespace gloam

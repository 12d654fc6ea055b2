// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/grass/lod/detail.h"

#include <algorithm>

namespace gloam {
namespace {

// Length of the longest blade in the picture, pixels, from which on the blades of a class have its segments.
constexpr std::array<float, GLOAM_GRASS_CLASSES> kClassPixels = {110.0f, 40.0f, 10.0f, 0.0f};

// Length of a blade in the picture, pixels, below which it runs two steps at once: its tip moves by less than half a
// pixel in a step at 1 m/s.
constexpr float kStridePixels = 24.0f;

/// Greatest key of distances up to distance_m.
std::uint32_t key_at(float distance_m, float range_m) {
  return static_cast<std::uint32_t>(std::clamp(distance_m / range_m * 255.0f, 0.0f, 254.0f));
}

}  // namespace

shaders::GrassLod grass_lod(const RenderView& view, const GrassKnobs& knobs, const DetailRange& range) {
  shaders::GrassLod lod{};
  const auto metres = static_cast<float>(range.metres_per_unit);
  for (std::size_t i = 0; i < 5; ++i)
    lod.planes[i] = vec4(view.frustum.planes[i].normal, view.frustum.planes[i].distance * metres);
  lod.range_m = range.range_m;
  lod.units_per_metre = static_cast<float>(1.0 / range.metres_per_unit);
  lod.orthographic = view.camera.orthographic ? 1u : 0u;
  // clip_from_view[1][1] is half the picture per unit, at a distance of one unit or, if orthographic, at all.
  lod.pixel_m = 2.0f / (std::abs(view.clip_from_view[1][1]) * static_cast<float>(view.height));
  if (view.camera.orthographic) lod.pixel_m *= metres;
  lod.width_px = knobs.lod_pixels;
  lod.threshold = knobs.threshold;
  lod.cast_m = knobs.cast_distance_m;
  lod.cast_key = knobs.cast_distance_m > 0.0f ? key_at(knobs.cast_distance_m, range.range_m) : GLOAM_GRASS_CULLED;
  lod.stride_px = knobs.far_steps ? kStridePixels : 0.0f;
  lod.cast_every = knobs.cast_every;
  std::uint32_t first_index = 0;
  for (int i = 0; i < GLOAM_GRASS_CLASSES; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const bool last = i + 1 == GLOAM_GRASS_CLASSES;
    const float end_m = range.blade_m / (kClassPixels[at] * lod.pixel_m);
    const bool all = last || (knobs.all_segments && i == 0) || lod.orthographic != 0u;
    lod.class_keys[i] = all ? 254u : key_at(end_m, range.range_m);
    lod.class_segments[i] = kClassSegments[at];
    lod.class_indices[i] = first_index;
    first_index += 6 * kClassSegments[at] * GLOAM_GRASS_DRAW_BLADES;
  }
  return lod;
}

std::vector<std::uint32_t> blade_indices() {
  std::vector<std::uint32_t> indices;
  for (const std::uint32_t segments : kClassSegments)
    for (std::uint32_t blade = 0; blade < GLOAM_GRASS_DRAW_BLADES; ++blade)
      for (std::uint32_t segment = 0; segment < segments; ++segment) {
        const std::uint32_t v = 2 * ((segments + 1) * blade + segment);
        indices.insert(indices.end(), {v, v + 1, v + 3, v, v + 3, v + 2});
      }
  return indices;
}

}  // namespace gloam

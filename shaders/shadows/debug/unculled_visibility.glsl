// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_SHADOWS_UNCULLED_VISIBILITY_GLSL
#define GLOAM_SHADERS_SHADOWS_UNCULLED_VISIBILITY_GLSL

// For visualizers shadow_unculled and shadow_filtered: the visibility of a light from its shadow maps, without lists,
// masks or classification. Include it after shadows_api.glsl.

layout(constant_id = 2) const uint kFilterAll = 0u;  // 1: chs_visibility() without its early-outs

// Runs the filter also where the search found that nothing or everything blocks.
float filtered_everywhere(ShadowPoint p) {
  float visibility, width;
  uint sectors;
  bool known = known_before_filter(p, visibility, width, sectors);
  if (known) width = penumbra_width(p, region_blockers(p, find_region(p)).depth);
  float filtered = filtered_visibility(p, width, sectors);
  return p.live ? filtered : visibility;
}

// Arguments: as for drawn_visibility().
float unculled_visibility(bool directional, uint light, vec3 light_vector, ShadowReceiver r, bool faces,
                          float extinction_m) {
  float visibility = faces ? light_visibility(directional, light, light_vector, r, extinction_m) : 0.0;
  if (kFilterAll == 0u || kFilter != 3u || !faces || extinction_m > 0.0) return visibility;
  ShadowPoint p = light_shadow_point(directional, light, light_vector, r);
  return quantised_visibility(filtered_everywhere(p) * p.horizon);
}

#endif

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_CLOSEUPS_LIGHT_OF_PAIR_GLSL
#define GLOAM_SHADERS_CLOSEUPS_LIGHT_OF_PAIR_GLSL

// The light of a close-up pair, and receivers in the pair's map. Before including this, define GLOAM_SHADOWS_KINDS (1
// for local lights, 4 for directional ones), include lights_api.glsl and shadows_api.glsl, and declare `closeup`, a
// CloseupConstants, and `light_texels`.

// Per-pair data of the light, the same for all pixels.
#if GLOAM_SHADOWS_KINDS == 4
struct LightOfPair {
  uint light;
};

LightOfPair light_of_pair() { return LightOfPair(closeup.light); }

ShadowPoint shadow_point(LightOfPair l, ShadowReceiver r) {
  SunReceiver s = sun_receiver(closeup.direction, closeup.penumbra_m_per_m, r);
  try_cascade(s,
              ShadowCascade(closeup.row_u, closeup.row_v, closeup.row_depth, closeup.origin, closeup.size,
                            closeup.texel_m, closeup.depth_m, 0.0, vec2(0.0)),
              true);
  return sun_shadow_point(s, r.subsurface);
}
#else
struct LightOfPair {
  LocalLight light;
};

LightOfPair light_of_pair() { return LightOfPair(fetch_light(light_texels, closeup.light)); }

ShadowPoint shadow_point(LightOfPair l, ShadowReceiver r) {
  LightFaces face;
  face.along_x = closeup.origin.xxx;
  face.along_y = closeup.origin.yyy;
  LocalShadow shadow =
      LocalShadow(l.light.position, vec4(GLOAM_SHADOW_SPOT, closeup.near_m, closeup.emitter_diameter_m, closeup.size),
                  vec4(closeup.right, closeup.tan_half), vec4(closeup.up, closeup.tan_inner),
                  cross(closeup.up, closeup.right), face);
  return local_shadow_point(shadow, r);
}
#endif

#endif

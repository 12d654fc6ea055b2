// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT

// Fragments of sprites: premultiplied light over what is behind, soft where the sprite meets a surface. With
// GLOAM_PARTICLE_PIXEL light is summed at each pixel. With GLOAM_PARTICLE_COUNT layers are counted.

#include "shaders/particles/particles_shared.h"
#include "shaders/particles/drawing/sprite_shape.glsl"
#include "shaders/render/view_api.glsl"

layout(constant_id = 1) const uint kClipped = 0u;  // 1: the view has a clip plane

layout(set = 0, binding = 0, scalar) uniform ViewBlock { ViewConstants view; };
layout(set = 0, binding = 7) uniform sampler2D depth_image;

layout(location = 0) in vec4 in_corner;
layout(location = 1) in vec3 in_light;
layout(location = 2) in vec3 in_relative;
layout(location = 3) flat in vec4 in_look;
layout(location = 4) flat in vec4 in_emission;
layout(location = 5) flat in uint in_outward;
layout(location = 6) flat in uint in_emitter;

layout(location = 0) out vec4 out_light;

#ifdef GLOAM_PARTICLE_PIXEL
layout(set = 0, binding = 1, scalar) uniform Frame { ParticleFrame frame; };
layout(set = 0, binding = 2, scalar) readonly buffer Emitters { ParticleEmitterRow emitters[]; };
#define GLOAM_PARTICLE_LIGHT_BINDING 8
#include "shaders/particles/lighting/scattered_light.glsl"
#endif

// Share of the sprite before the surface behind it, which thus cuts no line into it.
float soft_share() {
  float depth = texelFetch(depth_image, ivec2(gl_FragCoord.xy), 0).r;
  float surface_m = depth > 0.0 ? surface_view_depth(view, depth) : 1e30;
  return clamp((surface_m - in_look.y) * in_look.z, 0.0, 1.0);
}

void main() {
  float alpha = in_look.x * sprite_shape(in_corner.xy, in_corner.zw, in_emission.w) * soft_share();
  if (kClipped != 0u && is_clipped(view, in_relative)) alpha = 0.0;
#ifdef GLOAM_PARTICLE_COUNT
  out_light = vec4(alpha > 0.0 ? 1.0 : 0.0, alpha, 0.0, 0.0);
#else
  vec3 light = in_light;
#ifdef GLOAM_PARTICLE_PIXEL
  light = scattered_light(emitters[in_emitter], in_relative, outward_direction(in_outward, in_corner.xy));
#endif
  float cover = alpha * in_look.w;
  out_light = vec4(min(light * cover + in_emission.rgb * alpha, vec3(65504.0)), cover);
#endif
}

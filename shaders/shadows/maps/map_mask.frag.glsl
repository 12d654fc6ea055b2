// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/render/draw_shared.h"

// Discards the holes of cut-out casters, sampling alpha at the texture's finest level.

layout(location = 0) in vec3 in_uv_alpha;

// Declares the whole material set, so that sets made for other passes are compatible.
layout(set = 1, binding = 0, scalar) uniform MaterialBlock { MaterialConstants material; };
layout(set = 1, binding = 1) uniform sampler2D base_color_texture;
layout(set = 1, binding = 2) uniform sampler2D normal_texture;
layout(set = 1, binding = 3) uniform sampler2D metallic_roughness_texture;
layout(set = 1, binding = 4) uniform sampler2D occlusion_texture;
layout(set = 1, binding = 5) uniform sampler2D emissive_texture;

void main() {
  float alpha = textureLod(base_color_texture, in_uv_alpha.xy, 0.0).a * in_uv_alpha.z * material.base_color.a;
  if (alpha < material.emissive_cutoff.a) discard;
}

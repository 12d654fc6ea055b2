// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_SHADOWS_COOKIES_API_GLSL
#define GLOAM_SHADERS_SHADOWS_COOKIES_API_GLSL

#include "shaders/shadows/shadows_shared.h"

// Cookies for shaders that evaluate no shadows. Before including this, define GLOAM_COOKIES_BINDING, the first of three
// bindings: block, rows and cookies of ShadowsOutputs (read_shadows).

layout(set = 0, binding = GLOAM_COOKIES_BINDING, scalar) uniform ShadowBlockBinding { ShadowBlock shadow_block; };
layout(set = 0, binding = GLOAM_COOKIES_BINDING + 1) uniform sampler2D shadow_rows;
layout(set = 0, binding = GLOAM_COOKIES_BINDING + 2) uniform sampler2DArray shadow_cookies;

#include "shaders/shadows/filter/cookies.glsl"

#endif

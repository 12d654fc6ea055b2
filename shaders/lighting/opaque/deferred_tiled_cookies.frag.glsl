// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

// Deferred lighting with early lists, unshadowed, with cookies.

#define GLOAM_EARLY_LISTS_BINDING 11
#define GLOAM_COOKIES_BINDING 13
#include "shaders/lighting/opaque/deferred_tile_lights.glsl"

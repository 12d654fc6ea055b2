// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

// Deferred lighting with early lists, unshadowed, without cookies.

#define GLOAM_EARLY_LISTS_BINDING 11
#include "shaders/lighting/opaque/deferred_tile_lights.glsl"

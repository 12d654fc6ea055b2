// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

// Deferred lighting with early lists, with shadows (standard filter only) and cookies.

#define GLOAM_EARLY_LISTS_BINDING 11
#define GLOAM_SHADOWS_STANDARD
#define GLOAM_SHADOWS_BINDING 13
#include "shaders/lighting/opaque/deferred_tile_lights.glsl"

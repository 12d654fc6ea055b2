// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

// Deferred lighting with final lists, with cookies.

#define GLOAM_COOKIES_BINDING 13
#include "shaders/lighting/opaque/deferred_final_lights.glsl"

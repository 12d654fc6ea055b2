// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

// Deferred lighting without light lists, with shadows (standard filter only) and cookies.

#define GLOAM_SHADOWS_STANDARD
#define GLOAM_SHADOWS_BINDING 13
#include "shaders/lighting/opaque/deferred_all_lights.glsl"

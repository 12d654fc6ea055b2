// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

// Deferred lighting with final lists, without cookies.

#include "shaders/lighting/opaque/deferred_final_lights.glsl"

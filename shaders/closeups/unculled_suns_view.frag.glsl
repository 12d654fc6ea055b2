// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

// Visualizers shadow_unculled and shadow_filtered for pairs of directional lights.

#define GLOAM_SHADOWS_KINDS 4
#include "shaders/closeups/unculled_view.glsl"

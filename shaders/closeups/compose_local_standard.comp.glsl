// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

// Compose for local lights, standard filter only.

#define GLOAM_SHADOWS_STANDARD
#define GLOAM_SHADOWS_KINDS 1
#include "shaders/closeups/compose.glsl"

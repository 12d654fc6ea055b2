// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

// Transfer into an atlas of 16-bit depths.

#define GLOAM_SHADOW_ATLAS_FORMAT r16
#define GLOAM_SHADOW_ATLAS_STEPS 65535.0
#include "shaders/closeups/transfer.glsl"

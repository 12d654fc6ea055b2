// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

// Transfer into an atlas of 32-bit float depths.

#define GLOAM_SHADOW_ATLAS_FORMAT r32f
#include "shaders/closeups/transfer.glsl"

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#define GLOAM_SHADOW_ATLAS_FORMAT r16
#define GLOAM_SHADOW_ATLAS_STEPS 65535.0
#define GLOAM_SHADOW_BOUNDS_ONLY
#include "shaders/shadows/maps/mips.glsl"

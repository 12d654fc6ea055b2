// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

// geometry.frag with motion.

#define GLOAM_MOTION
#include "shaders/render/gbuffer/geometry.glsl"

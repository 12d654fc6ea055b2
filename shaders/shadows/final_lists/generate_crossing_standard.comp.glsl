// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#define GLOAM_SHADOWS_STANDARD
#define GLOAM_SHADOWS_KINDS 3
#include "shaders/shadows/final_lists/generate.glsl"

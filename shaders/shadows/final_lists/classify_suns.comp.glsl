// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#define GLOAM_CLASSIFY_SUNS
#include "shaders/shadows/final_lists/classify.glsl"

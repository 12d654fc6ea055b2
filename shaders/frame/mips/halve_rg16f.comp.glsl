// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#define GLOAM_MIP_FORMAT rg16f
#include "shaders/frame/mips/halve.glsl"

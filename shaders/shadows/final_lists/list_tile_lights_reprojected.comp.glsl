// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#define GLOAM_SHADOWS_KEEP
#define GLOAM_SHADOWS_REPROJECT
#include "shaders/shadows/final_lists/list_tile_lights.glsl"

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_SHADOWS_SHADOW_MAPS_API_GLSL
#define GLOAM_SHADERS_SHADOWS_SHADOW_MAPS_API_GLSL

// The layout of shadow maps, their mips and pyramids, for shaders that access them as images.
#include "shaders/shadows/shadows_shared.h"

#endif

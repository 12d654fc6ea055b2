// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_SHADOWS_SHADOW_MAPS_API_GLSL
#define GLOAM_SHADERS_SHADOWS_SHADOW_MAPS_API_GLSL

// How shadow maps, their mips and pyramids lie in their images, for shaders that read or write them as images.
#include "shaders/shadows/shadows_shared.h"

#endif

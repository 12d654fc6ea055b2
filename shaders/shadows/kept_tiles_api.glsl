// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_SHADOWS_KEPT_TILES_API_GLSL
#define GLOAM_SHADERS_SHADOWS_KEPT_TILES_API_GLSL

#include "shaders/shadows/final_lists_shared.h"

// The light's bit in KeptTile::composed and KeptTile::anew. Several lights may share one. light: index among the view's
// directional or local lights.
uint kept_light_bit(bool directional, uint light) { return 1u << (directional ? 28u + (light & 3u) : light % 28u); }

#endif

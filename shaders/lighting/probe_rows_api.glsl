// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_LIGHTING_PROBE_ROWS_API_GLSL
#define GLOAM_SHADERS_LIGHTING_PROBE_ROWS_API_GLSL

// ProbeRow, for shaders that declare the buffer of rows before they include probes_api.glsl.
#include "shaders/lighting/probes_shared.h"

#endif

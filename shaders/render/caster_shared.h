// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_RENDER_CASTER_SHARED_H
#define GLOAM_SHADERS_RENDER_CASTER_SHARED_H

#include "shaders/common/prelude.h"

GLOAM_SHARED_BEGIN

/// Push constants that draw casters into one face of a map. clip_from_local is composed in double relative to the
/// light.
struct CasterConstants {
  mat4 clip_from_local;
  uint orthographic;  // 1: vertices in front of the near side are moved onto it
};

GLOAM_SHARED_END

#endif

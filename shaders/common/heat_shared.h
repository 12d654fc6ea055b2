// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_COMMON_HEAT_SHARED_H
#define GLOAM_SHADERS_COMMON_HEAT_SHARED_H

// Heat scale of visualizers: colours in linear RGB at equal steps from 0 to the scale's end: black, blue, cyan, green,
// yellow, red. Values above the end are white.
#define GLOAM_HEAT_STOPS 6
#define GLOAM_HEAT_COLORS                                                                             \
  vec3(0.0), vec3(0.02, 0.05, 0.6), vec3(0.0, 0.45, 0.6), vec3(0.05, 0.5, 0.05), vec3(0.8, 0.6, 0.0), \
      vec3(0.8, 0.02, 0.02)

#endif

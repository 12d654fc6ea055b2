// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_DEPTH_OF_FIELD_KERNEL_API_GLSL
#define GLOAM_SHADERS_DEPTH_OF_FIELD_KERNEL_API_GLSL

// The shape of the aperture: a disc, or a hexagon with a corner at the top, with an edge that is one texel soft. A
// hexagon's radius is that of the circle inside it.

layout(constant_id = 0) const uint kHexagonal = 0u;

const float kInnerRadius = 0.8660254;  // of a hexagon whose corners are 1 from its centre

// Distance from the centre in the aperture's own measure: equal along its edge.
float aperture_distance(vec2 d) {
  if (kHexagonal == 0u) return length(d);
  vec2 a = abs(d);
  return max(a.x, 0.5 * a.x + kInnerRadius * a.y);
}

// Share of a texel at this distance that lies in the aperture.
float aperture_cover(float distance, float radius) { return clamp(radius + 0.5 - distance, 0.0, 1.0); }

// Its sum over all texels, within 3 % from a radius of 1.9 on. soft: the width of the edge in texels.
float soft_aperture_area(float radius, float soft) {
  return (kHexagonal == 0u ? 3.14159265 : 3.46410162) * (radius * radius + soft * soft / 12.0);
}
float aperture_area(float radius) { return soft_aperture_area(radius, 1.0); }

// Sum of aperture_cover() over all texels: exact below a radius of 2.4, where few texels have a weight.
float aperture_sum(float radius) {
  if (radius >= 2.4) return aperture_area(radius);
  if (kHexagonal == 0u)
    return 1.0 * aperture_cover(0.0, radius) + 4.0 * aperture_cover(1.0, radius) +
           4.0 * aperture_cover(1.4142, radius) + 4.0 * aperture_cover(2.0, radius) +
           8.0 * aperture_cover(2.2361, radius) + 4.0 * aperture_cover(2.8284, radius);
  return 1.0 * aperture_cover(0.0, radius) + 2.0 * aperture_cover(0.866, radius) + 2.0 * aperture_cover(1.0, radius) +
         4.0 * aperture_cover(1.366, radius) + 2.0 * aperture_cover(1.7321, radius) +
         6.0 * aperture_cover(2.0, radius) + 4.0 * aperture_cover(2.2321, radius) +
         2.0 * aperture_cover(2.5981, radius) + 4.0 * aperture_cover(2.7321, radius);
}

// Radius of the kernel of circles with this radius in pixels: at level 0 the circle's own. At other levels texels that
// are interpolated blur by themselves, with the variance of a circle with the radius of one texel. The kernel adds what
// is missing.
float kernel_radius(float circle, int level) {
  float inner = kHexagonal == 0u ? 1.0 : kInnerRadius;
  if (level == 0) return max(inner * circle, 0.5);
  float texels = circle / float(1 << level), missing = texels * texels - (kHexagonal == 0u ? 1.0 : 1.2);
  return max(inner * sqrt(max(missing, 0.0)), 0.5);
}

// The greatest square of the distance of a texel that has a weight in a kernel. Layers store radii in eighths.
int texels_of(float radius) {
  float edge = (radius + 0.5625) * (kHexagonal == 0u ? 1.0 : 1.0 / kInnerRadius) * 1.001;
  return int(ceil(edge * edge)) - 1;
}

#endif

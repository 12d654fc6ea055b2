// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

#include "engine/core/assert.h"
#include "modules/grass/growth/blade_types.h"

namespace gloam {
namespace {

struct StemPoint {
  double forward = 0.0;
  double up = 0.0;
};
StemPoint mix(const StemPoint& a, const StemPoint& b, double t) {
  return {a.forward + (b.forward - a.forward) * t, a.up + (b.up - a.up) * t};
}
double dot(const StemPoint& a, const StemPoint& b) { return a.forward * b.forward + a.up * b.up; }
StemPoint difference(const StemPoint& to, const StemPoint& from) {
  return {to.forward - from.forward, to.up - from.up};
}
double distance(const StemPoint& a, const StemPoint& b) {
  const StemPoint d = difference(b, a);
  return std::sqrt(dot(d, d));
}

/// The quadratic B-spline of the control points as a fine polyline.
std::vector<StemPoint> flatten(const std::vector<vec2>& points) {
  constexpr int kSteps = 32;  // a span
  std::vector<StemPoint> controls;
  for (const vec2& p : points) controls.push_back({double{p.x}, double{p.y}});
  if (controls.size() == 2) return controls;
  std::vector<StemPoint> line = {controls.front()};
  const std::size_t last = controls.size() - 1;
  for (std::size_t i = 1; i < last; ++i) {
    const StemPoint from = i == 1 ? controls.front() : mix(controls[i - 1], controls[i], 0.5);
    const StemPoint to = i + 1 == last ? controls.back() : mix(controls[i], controls[i + 1], 0.5);
    for (int s = 1; s <= kSteps; ++s) {
      const double t = double(s) / kSteps;
      line.push_back(mix(mix(from, controls[i], t), mix(controls[i], to, t), t));
    }
  }
  return line;
}

/// Share of the segment from `inside` to `outside` at which it leaves the circle around `center`.
double leaving_share(const StemPoint& center, double radius, const StemPoint& inside, const StemPoint& outside) {
  const StemPoint way = difference(outside, inside);
  const StemPoint start = difference(inside, center);
  const double a = dot(way, way);
  const double b = dot(way, start);
  const double c = dot(start, start) - radius * radius;  // ≤ 0
  if (!(a > 0.0)) return 1.0;
  return std::clamp((std::sqrt(std::max(b * b - a * c, 0.0)) - b) / a, 0.0, 1.0);
}

/// Walks along the polyline in steps whose ends are `chord` apart. Returns whether all steps fit.
bool place_knots(const std::vector<StemPoint>& line, double chord, std::span<StemPoint> knots) {
  knots[0] = line.front();
  StemPoint begin = line.front();  // of the rest of the segment that ends at line[next]
  std::size_t next = 1;
  for (std::size_t knot = 1; knot < knots.size(); ++knot) {
    const StemPoint from = knots[knot - 1];
    while (next < line.size() && distance(from, line[next]) < chord) begin = line[next++];
    if (next == line.size()) return false;
    begin = mix(begin, line[next], leaving_share(from, chord, begin, line[next]));
    knots[knot] = begin;
  }
  return true;
}

}  // namespace

std::vector<glm::dvec2> stem_knots(const BladeType& type, std::size_t count) {
  GLOAM_ASSERT(type.points.size() >= 2 && count >= 2, "a stem has at least two control points and two knots");
  const auto segments = static_cast<double>(count - 1);
  const std::vector<StemPoint> line = flatten(type.points);
  double length = 0.0;
  for (std::size_t i = 1; i < line.size(); ++i) length += distance(line[i - 1], line[i]);
  double fits = 0.0;
  double too_long = length / segments * (1.0 + 1e-9);
  std::vector<StemPoint> knots(count);
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (fits + too_long);
    (place_knots(line, middle, knots) ? fits : too_long) = middle;
  }
  static_cast<void>(place_knots(line, fits, knots));
  const double scale = 1.0 / (fits * segments);
  std::vector<glm::dvec2> found;
  for (const StemPoint& knot : knots) found.emplace_back(knot.forward * scale, knot.up * scale);
  return found;
}

shaders::GrassTypeRow blade_type_row(const BladeType& type, float damping) {
  const std::vector<glm::dvec2> knots = stem_knots(type, GLOAM_GRASS_KNOTS);
  shaders::GrassTypeRow row{};
  for (std::size_t i = 0; i < knots.size(); ++i) row.stem[i] = vec2(knots[i]);
  row.stiffness = type.stiffness;
  row.taper = type.taper;
  row.damping = type.damping * damping;
  return row;
}

}  // namespace gloam

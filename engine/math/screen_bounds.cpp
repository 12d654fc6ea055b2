// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// Spheres: Mara and McGuire, "2D Polyhedral Bounds of a Clipped, Perspective-Projected 3D Sphere" (JCGT 2(2), 2013),
// its axis-aligned case. Changed: each screen axis is bounded separately as a slope x / d, in forms that never subtract
// nearly equal numbers, so that a radius of 1e6 m beside a near plane at 1e-6 m keeps its digits.
//
// Cones: our own method. Let the support function h(μ) be the greatest x + μ·d over a convex body. Then every μ gives
// the bound
//   x / d ≤ max(0, h(μ)) / near − μ    for all points of the body with d ≥ near,
// and the least of these bounds over all μ is tight (convex duality). The best μ is the inclination of one of two
// planes: a plane through the camera that is tangent to the body, or a tangent plane at the cut of the body with the
// near plane. Both have closed forms for the apex, the cap, the rim and the flank. All candidates are tried and the
// least bound is taken, so a badly rounded candidate only costs tightness: no point is ever lost.
#include "engine/math/screen_bounds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "engine/core/assert.h"
#include "engine/math/finite.h"

namespace gloam {
namespace {

constexpr double kHalfPi = 3.14159265358979323846 / 2;
/// Margin on every side, in normalised device coordinates: four ulps of a float just below 1, more than the rounding
/// error of projecting a point in floats.
constexpr double kWidening = 0x1p-22;
/// Relative bound on the rounding error of a support function.
constexpr double kSupportRounding = 8 * std::numeric_limits<double>::epsilon();
/// Relative step that lowers the inclination of a tangent through the camera, so that its support function stays ≤ 0 in
/// spite of rounding: a positive remainder would be divided by the near distance and loosen the bound.
constexpr double kTangentStep = 1e-13;
/// Where a body only touches the near plane, the best inclination is infinite and its bound is lost in rounding. The
/// squared radius of the body's cut with the near plane is therefore taken as at least this share of the squared radius
/// of the cap or the rim.
constexpr double kTouch = 1e-14;

const NdcRect kWholeScreen{};
const NdcRect kNothing{vec2(0.0f), vec2(0.0f), true};

bool is_usable(const PerspectiveScale& projection) {
  GLOAM_ASSERT(!(projection.scale.x <= 0.0f) && !(projection.scale.y <= 0.0f), "a projection's scale is positive");
  GLOAM_ASSERT(!(projection.near_m <= 0.0f), "a projection's near distance is positive");
  return std::isfinite(projection.scale.x) && std::isfinite(projection.scale.y) && std::isfinite(projection.near_m);
}

/// Least and greatest slope x / d of a body on one screen axis, seen from the camera.
struct Slopes {
  double min = 0.0;
  double max = 0.0;
};

NdcRect rect_from(Slopes x, Slopes y, vec2 scale) {
  const double left = x.min * scale.x - kWidening;
  const double right = x.max * scale.x + kWidening;
  const double bottom = y.min * scale.y - kWidening;
  const double top = y.max * scale.y + kWidening;
  if (left > 1.0 || right < -1.0 || bottom > 1.0 || top < -1.0) return kNothing;
  // Clamped before the conversion: a slope may exceed the range of floats.
  return {vec2(std::clamp(left, -1.0, 1.0), std::clamp(bottom, -1.0, 1.0)),
          vec2(std::clamp(right, -1.0, 1.0), std::clamp(top, -1.0, 1.0)), false};
}

/// Intersection of two rectangles. If both contain everything visible, so does the intersection.
NdcRect overlap(const NdcRect& a, const NdcRect& b) {
  if (a.empty || b.empty) return kNothing;
  const NdcRect both{glm::max(a.min, b.min), glm::min(a.max, b.max), false};
  return both.min.x > both.max.x || both.min.y > both.max.y ? kNothing : both;
}

/// x² + d² − r², accurate to the last digits: squares of floats are exact in double, and the rounding error of the sum
/// is added back.
double tangent_length_squared(double x, double d, double r) {
  const double xx = x * x;
  const double dd = d * d;
  const double sum = xx + dd;
  const double dd_taken = sum - xx;
  const double lost = (xx - (sum - dd_taken)) + (dd - dd_taken);
  return (sum - r * r) + lost;
}

/// Greatest slope x / d over the part with d ≥ near of a disc, the sphere projected along the other screen axis. The
/// arguments hold values of floats; some part of the disc has d ≥ near.
double greatest_slope(double x, double d, double r, double near) {
  const bool touches_in_front = x > 0.0 ? d > r : d > -r;
  const double tt = tangent_length_squared(x, d, r);
  if (touches_in_front && tt > 0.0) {
    const double t = std::sqrt(tt);
    const double slope = x * d >= 0.0 ? (x * d + t * r) / ((d - r) * (d + r)) : ((x - r) * (x + r)) / (x * d - t * r);
    // The depth of the tangent point is t / √(1 + slope²).
    if (d - r >= near || tt >= near * near * (1.0 + slope * slope)) return slope;
  }
  const double half_chord_squared = ((r - d) + near) * ((r + d) - near);
  return (x + std::sqrt(std::max(half_chord_squared, 0.0))) / near;
}

Slopes sphere_slopes(double x, double d, double r, double near) {
  return {-greatest_slope(-x, d, r, near), greatest_slope(x, d, r, near)};
}

/// Solid spherical sector in the coordinates of one screen axis: x along that axis, y along the other, d the view
/// depth.
struct Sector {
  dvec3 apex;  ///< x, y, d
  dvec3 axis;  ///< x, y, d; unit
  double cosine = 1.0;
  double sine = 0.0;
  double range = 0.0;
};

/// Bound on the slope x / d for the inclination μ; see the head of this file.
double slope_bound(const Sector& s, double mu, double near) {
  const double cross_x = mu * s.axis.y;
  const double cross_y = mu * s.axis.x - s.axis.z;
  const double along = s.axis.x + mu * s.axis.z;
  const double across = std::sqrt(cross_x * cross_x + cross_y * cross_y + s.axis.y * s.axis.y);
  const double length = std::sqrt(1.0 + mu * mu);
  const bool cap = across * s.cosine <= along * s.sine;
  const double outward = cap ? length : along * s.cosine + across * s.sine;
  // If the direction clearly points away from the sector, the range adds nothing to the apex, not even rounding.
  const double margin = kSupportRounding * length;
  const double beyond_apex = outward > -margin ? s.range * (std::max(outward, 0.0) + margin) : 0.0;
  const double apex_rounding = kSupportRounding * (std::abs(s.apex.x) + std::abs(mu * s.apex.z));
  const double support = s.apex.x + mu * s.apex.z + beyond_apex + apex_rounding;
  return std::max(support, 0.0) / near - mu;
}

/// Least bound of all candidates tried so far. Candidates that are not finite are skipped.
struct LeastBound {
  const Sector& sector;
  double near;
  double slope = std::numeric_limits<double>::infinity();

  void try_crossing(double mu) {
    if (!std::isfinite(mu)) return;
    const double bound = slope_bound(sector, mu, near);
    if (bound < slope) slope = bound;
  }
  void try_tangent(double mu) { try_crossing(mu - kTangentStep * (1.0 + std::abs(mu))); }
  /// Tries both roots of a·μ² + 2·b·μ + c = 0. The discriminant b² − a·c is given; rounding may make a zero negative.
  template <class Try>
  void roots(double a, double b, double c, double discriminant, Try&& attempt) {
    const double q = -(b + std::copysign(std::sqrt(std::max(discriminant, 0.0)), b));
    attempt(q / a);
    attempt(c / q);
  }
};

double greatest_slope(const Sector& s, double near) {
  const auto square = [](double v) { return v * v; };
  LeastBound least{s, near};
  const auto tangent = [&](double mu) { least.try_tangent(mu); };
  const auto crossing = [&](double mu) { least.try_crossing(mu); };
  const dvec3& apex = s.apex;
  const dvec3& axis = s.axis;

  tangent(-apex.x / apex.z);
  tangent(-greatest_slope(apex.x, apex.z, s.range, near));
  // The point with the greatest x where the cap crosses the near plane.
  const double lean = (near - apex.z) / s.range;
  crossing(lean / std::sqrt(std::max((1.0 - lean) * (1.0 + lean), kTouch)));
  // The two generators of the flank whose tangent planes are parallel to the other screen axis.
  const double ss = s.sine * s.sine;
  const double flat = square(axis.x) + square(axis.z);
  least.roots(square(axis.z) - ss, axis.x * axis.z, square(axis.x) - ss, ss * (flat - ss), crossing);
  // The rim: a circle around `rim`. First its tangent planes through the camera, then its crossing of the near plane.
  const dvec3 rim = apex + s.range * s.cosine * axis;
  const double rr = square(s.range * s.sine);
  const double q2 = square(axis.x) + square(axis.y);
  const double q1 = -axis.x * axis.z;
  const double q0 = square(axis.y) + square(axis.z);
  const double facing = square(axis.y) * (square(rim.x) + square(rim.z) - rr) + square(rim.x * axis.x + rim.z * axis.z);
  least.roots(square(rim.z) - rr * q2, rim.x * rim.z - rr * q1, square(rim.x) - rr * q0, rr * facing, tangent);
  const double above = near - rim.z;
  const double room = std::max(rr * q2 - above * above, kTouch * rr * q2);
  const double w = above * std::abs(axis.y) / std::sqrt(room);
  crossing((w - q1) / q2);
  return least.slope;
}

Slopes sector_slopes(const Sector& s, double near) {
  Sector mirrored = s;
  mirrored.apex.x = -s.apex.x;
  mirrored.axis.x = -s.axis.x;
  return {-greatest_slope(mirrored, near), greatest_slope(s, near)};
}

double greatest_depth(const Sector& s) {
  const double along = s.axis.z;
  const double across = std::sqrt(s.axis.x * s.axis.x + s.axis.y * s.axis.y);
  const double outward = across * s.cosine <= along * s.sine ? 1.0 : along * s.cosine + across * s.sine;
  const double terms = std::abs(s.apex.z) + s.range;
  return s.apex.z + s.range * std::max(outward, 0.0) + kSupportRounding * terms;
}

}  // namespace

NdcRect screen_bounds(const Sphere& view_sphere, const PerspectiveScale& projection) {
  GLOAM_ASSERT(!(view_sphere.radius < 0.0f), "a sphere's radius is not negative");
  if (!is_usable(projection)) return kWholeScreen;
  if (!is_finite(view_sphere.center) || !std::isfinite(view_sphere.radius)) return kWholeScreen;
  const double near = projection.near_m;
  const double d = -static_cast<double>(view_sphere.center.z);
  const double r = view_sphere.radius;
  if (d + r < near) return kNothing;
  return rect_from(sphere_slopes(view_sphere.center.x, d, r, near), sphere_slopes(view_sphere.center.y, d, r, near),
                   projection.scale);
}

NdcRect screen_bounds(const Cone& view_cone, const PerspectiveScale& projection) {
  if (!is_usable(projection)) return kWholeScreen;
  if (!is_finite(view_cone.apex) || !is_finite(view_cone.axis)) return kWholeScreen;
  if (!std::isfinite(view_cone.half_angle) || !std::isfinite(view_cone.range_m)) return kWholeScreen;
  GLOAM_ASSERT(std::abs(glm::length(view_cone.axis) - 1.0f) < 1e-3f, "a cone's axis is a unit vector");
  const NdcRect around = screen_bounds(bounding_sphere(view_cone), projection);
  if (around.empty) return kNothing;

  const double near = projection.near_m;
  const double angle = std::min<double>(view_cone.half_angle, kHalfPi);
  const dvec3 apex(view_cone.apex);
  const dvec3 axis = glm::normalize(dvec3(view_cone.axis));
  const Sector x{dvec3(apex.x, apex.y, -apex.z), dvec3(axis.x, axis.y, -axis.z), std::cos(angle), std::sin(angle),
                 view_cone.range_m};
  if (greatest_depth(x) < near) return kNothing;
  const Sector y{dvec3(apex.y, apex.x, -apex.z), dvec3(axis.y, axis.x, -axis.z), x.cosine, x.sine, x.range};
  return overlap(around, rect_from(sector_slopes(x, near), sector_slopes(y, near), projection.scale));
}

}  // namespace gloam

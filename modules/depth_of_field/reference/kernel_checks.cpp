// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/depth_of_field/reference/kernel_checks.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "engine/core/text/formatted.h"
#include "modules/depth_of_field/reference/blur_run.h"
#include "modules/depth_of_field/reference/blur_twin.h"
#include "modules/depth_of_field/reference/spot.h"

namespace gloam {
namespace {

constexpr float kBrightest = 65504.0f;  // of a half float

std::string words_of(const DofInput& in) {
  return formatted("%s, %s size, radius %g", in.bokeh == Bokeh::round ? "round" : "hexagonal",
                   in.knobs.full_resolution ? "full" : "half", static_cast<double>(in.knobs.radius));
}

Result<KernelError> run_blur_cases(KernelLab& lab) {
  KernelError error;
  DofInput in = objects_in_depth(81, 67, 1);
  in.knobs.radius = 15.0f;
  for (const Bokeh bokeh : {Bokeh::round, Bokeh::hexagonal})
    for (const bool full : {false, true}) {
      in.bokeh = bokeh;
      in.knobs.full_resolution = full;
      const auto found = run_dof(lab, in);
      if (!found) return found.error();
      const std::vector<dvec4> expected = dof_twin_light(in);
      for (std::size_t i = 0; i < expected.size(); ++i)
        for (int c = 0; c < 3; ++c) {
          const double apart = std::abs(static_cast<double>(found->light[i][c]) - expected[i][c]);
          error.add(apart / (std::abs(expected[i][c]) + 0.01), words_of(in));
        }
    }
  return error;
}

/// What becomes of one bright pixel of a dark picture whose circles of confusion are equal.
Result<Spot> draw_spot(const KernelLab& lab, Bokeh bokeh, bool full, bool near) {
  constexpr std::uint32_t kSide = 96;
  DofInput in(kSide, kSide, near ? -15.0f : 15.0f, vec4(0.0f, 0.0f, 0.0f, 1.0f));
  in.light[in.at(kSide / 2 + 3, kSide / 2 + 1)] = vec4(vec3(kBrightest), 1.0f);
  in.knobs.full_resolution = full;
  in.knobs.radius = 15.0f;
  in.bokeh = bokeh;
  const auto found = run_dof(lab, in);
  if (!found) return found.error();
  std::vector<double> values;
  for (const vec4& light : found->light) values.push_back(static_cast<double>(light.x));
  return Spot(static_cast<int>(kSide), static_cast<int>(kSide), std::move(values));
}

/// The greatest length over the least: of the radii at half the light, or of the sides of a hexagon.
double unevenness(const Spot& spot, Bokeh bokeh) {
  double least = 1e9, most = 0.0;
  const auto add = [&](double length) {
    least = std::min(least, length);
    most = std::max(most, length);
  };
  if (bokeh == Bokeh::round) {
    const double level = 0.5 * spot.mean_within(1.0);
    for (int i = 0; i < 64; ++i) add(glm::distance(spot.outline(i * std::numbers::pi / 32.0, level), spot.centre()));
  } else {
    const auto corners = hexagon_corners(spot, 0.5 * spot.mean_within(7.5));
    for (std::size_t i = 0; i < corners.size(); ++i) add(glm::distance(corners[i], corners[(i + 1) % corners.size()]));
  }
  return most / least - 1.0;
}

Result<KernelError> run_spots(const KernelLab& lab, double (*error_of)(const Spot& spot, Bokeh bokeh)) {
  KernelError error;
  for (const Bokeh bokeh : {Bokeh::round, Bokeh::hexagonal})
    for (const bool full : {false, true})
      for (const bool near : {false, true}) {
        const auto spot = draw_spot(lab, bokeh, full, near);
        if (!spot) return spot.error();
        error.add(error_of(*spot, bokeh),
                  formatted("%s, %s size, %s the focus", bokeh == Bokeh::round ? "round" : "hexagonal",
                            full ? "full" : "half", near ? "before" : "behind"));
      }
  return error;
}

constexpr const char* kDofAdvice = "Leave gloam.dof out of cameras, or set another dof.cache, and report the device";

}  // namespace

std::vector<KernelCheck> dof_kernel_checks() {
  return {{.name = "kernel.lens_blur",
           .sentence = "a picture blurred by the lens against the same passes in double precision",
           .unit = "of the light",
           // Up to eight roundings to half floats of 2^-11 each, and weights of few bits between tiles.
           .bound = 8.0 / 1024.0,
           .advice = kDofAdvice,
           .quick = false,
           .run = &run_blur_cases},
          {.name = "kernel.bokeh_energy",
           .sentence = "light of a spot that was one pixel against the light of the pixel",
           .unit = "of the light",
           // The area of a disc in pixels is known to 1 % from a radius of 2 on.
           .bound = 0.01,
           .advice = kDofAdvice,
           .quick = true,
           .run =
               [](KernelLab& lab) {
                 return run_spots(lab, [](const Spot& spot, Bokeh) {
                   return std::abs(spot.energy() / static_cast<double>(kBrightest) - 1.0);
                 });
               }},
          {.name = "kernel.bokeh_shape",
           .sentence = "radii of a round spot, and sides of a hexagonal one, against one another",
           .unit = "of the length",
           // The outline of a spot of 9 pixels is found to a quarter of a pixel at most.
           .bound = 0.04,
           .advice = kDofAdvice,
           .quick = false,
           .run = [](KernelLab& lab) { return run_spots(lab, &unevenness); }}};
}

}  // namespace gloam

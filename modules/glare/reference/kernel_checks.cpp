// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/glare/reference/kernel_checks.h"

#include <cmath>
#include <memory>
#include <string>

#include "engine/core/text/formatted.h"
#include "modules/glare/reference/glare_run.h"
#include "modules/glare/reference/spread_light.h"

namespace gloam {
namespace {

constexpr double kLamp = 60000.0;

struct Moments {
  double energy = 0.0;
  glm::dvec2 centre{0.0};  ///< pixels
};

template <class T>
Moments moments_of(const std::vector<T>& light, std::uint32_t width) {
  Moments moments;
  for (std::size_t i = 0; i < light.size(); ++i) {
    const double value = static_cast<double>(light[i].x);
    moments.energy += value;
    moments.centre += value * (glm::dvec2(static_cast<double>(i % width), static_cast<double>(i / width)) + 0.5);
  }
  moments.centre /= moments.energy;
  return moments;
}

/// The spread light of a lamp, and what it must be.
struct LampSpread {
  GlareInput in;
  std::vector<vec4> found;
  std::vector<dvec3> right;
};

Result<LampSpread> spread_lamp(const KernelLab& lab, glm::dvec2 offset_px) {
  GlareInput in(uvec2(320, 180));
  in.add_lamp(glm::dvec2(150.5, 84.5) + offset_px, kLamp);
  auto found = run_glare(lab, in);
  if (!found) return found.error();
  const std::unique_ptr<JobExecutor> executor = make_serial_executor();
  std::vector<dvec3> right = spread_light(in.light, in.size, *executor);
  return LampSpread{std::move(in), std::move(found).value(), std::move(right)};
}

constexpr glm::dvec2 kOffsets[] = {{0.0, 0.0}, {1.0, 0.0}, {0.25, 2.0}, {3.0, 1.5}};  // pixels; a cell has two

Result<KernelError> over_lamps(const KernelLab& lab, double (*error_of)(const LampSpread& lamp)) {
  KernelError error;
  for (const glm::dvec2& offset : kOffsets) {
    const auto lamp = spread_lamp(lab, offset);
    if (!lamp) return lamp.error();
    error.add(error_of(*lamp), formatted("a lamp %g, %g pixels from a cell's corner", offset.x, offset.y));
  }
  return error;
}

double energy_error(const LampSpread& lamp) {
  return std::abs(moments_of(lamp.found, lamp.in.size.x).energy / moments_of(lamp.right, lamp.in.size.x).energy - 1.0);
}

double place_error(const LampSpread& lamp) {
  return glm::distance(moments_of(lamp.found, lamp.in.size.x).centre, moments_of(lamp.right, lamp.in.size.x).centre);
}

/// Mean difference of the spread light over its mean.
double spread_error(const LampSpread& lamp) {
  double apart = 0.0, sum = 0.0;
  for (std::size_t i = 0; i < lamp.right.size(); ++i) {
    apart += std::abs(static_cast<double>(lamp.found[i].x) - lamp.right[i].x);
    sum += lamp.right[i].x;
  }
  return apart / sum;
}

constexpr const char* kGlareAdvice = "Set glare.lines=off, and report the device";

}  // namespace

std::vector<KernelCheck> glare_kernel_checks() {
  return {{.name = "kernel.glare_energy",
           .sentence = "the scattered light of a lamp against that of the convolution of the whole picture",
           .unit = "of the light",
           // Fifteen roundings to half floats.
           .bound = 0.005,
           .advice = kGlareAdvice,
           .quick = true,
           .run = [](KernelLab& lab) { return over_lamps(lab, &energy_error); }},
          {.name = "kernel.glare_place",
           .sentence = "the centre of a lamp's scattered light against that of the convolution",
           .unit = "pixels",
           .bound = 0.1,
           .advice = kGlareAdvice,
           .quick = true,
           .run = [](KernelLab& lab) { return over_lamps(lab, &place_error); }},
          {.name = "kernel.glare_spread",
           .sentence = "mean difference of a lamp's scattered light from the convolution of the whole picture",
           .unit = "of the light",
           // Cells of two pixels, and blurs that are not quite Gaussians, give 0.042.
           .bound = 0.06,
           .advice = kGlareAdvice,
           .quick = true,
           .run = [](KernelLab& lab) { return over_lamps(lab, &spread_error); }}};
}

}  // namespace gloam

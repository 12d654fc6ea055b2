// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "engine/render/kernel_check/deform_run.h"
#include "engine/render/kernel_check/engine_checks.h"

namespace gloam {
namespace {

struct DeformCase {
  const char* words;
  DeformInput input;
};

std::vector<DeformCase> deform_cases() {
  DeformInputs inputs(31);
  std::vector<DeformCase> cases;
  cases.push_back({"four influences", inputs.vertices(1000)});
  inputs.add_skin(cases.back().input, 9, dvec3(1.0));
  cases.push_back({"uneven scales", inputs.vertices(1000)});
  inputs.add_skin(cases.back().input, 5, dvec3(0.3, 2.0, 1.0));
  cases.push_back({"mirrored joints", inputs.vertices(1000)});
  inputs.add_skin(cases.back().input, 5, dvec3(-1.0, 1.0, 1.0));
  cases.push_back({"seven morph targets", inputs.vertices(1000)});
  inputs.add_morphs(cases.back().input, 7, true);
  cases.push_back({"morphed, then skinned", inputs.vertices(1000)});
  inputs.add_morphs(cases.back().input, 3, true);
  inputs.add_skin(cases.back().input, 4, dvec3(1.0, 0.5, 1.5));
  return cases;
}

/// Degrees from the twin's directions; a wrong handedness is a right angle.
double turned_degrees(const PackedFrame& found, const DeformedVertex& expected) {
  const double normal = degrees_between(decoded_direction(found.normal), expected.normal);
  const double tangent = degrees_between(decoded_direction(found.tangent & ~kHandednessBit), expected.tangent);
  const bool left_handed = (found.tangent & kHandednessBit) != 0;
  return std::max({normal, tangent, left_handed != expected.left_handed ? 90.0 : 0.0});
}

using VertexError = double (*)(const DeformedVertices& found, std::size_t vertex, const DeformedVertex& expected);

Result<KernelError> run_deform_cases(const KernelLab& lab, VertexError error_of) {
  KernelError error;
  for (const DeformCase& own : deform_cases()) {
    const auto found = run_deform(lab, own.input);
    if (!found) return found.error();
    const DeformTwin twin(own.input);
    for (std::size_t v = 0; v < own.input.constants.vertex_count; ++v)
      error.add(error_of(*found, v, twin.move(v)), own.words);
  }
  return error;
}

constexpr const char* kDeformAdvice = "Report the device: show skinned and morphed meshes at rest until then";

}  // namespace

std::vector<KernelCheck> deform_checks() {
  KernelCheck positions = {.name = "kernel.skinned_positions",
                           .sentence = "positions of morphed and skinned vertices against those in double precision",
                           .unit = "m",
                           // About ten products of up to 16 m, each rounded to 2^-21 m.
                           .bound = 5e-6,
                           .advice = kDeformAdvice,
                           .quick = true,
                           .run = [](KernelLab& lab) {
                             return run_deform_cases(
                                 lab, [](const DeformedVertices& found, std::size_t v, const DeformedVertex& expected) {
                                   return glm::length(dvec3(found.positions[v]) - expected.position);
                                 });
                           }};
  KernelCheck directions = {
      .name = "kernel.skinned_normals",
      .sentence = "normals and tangents of these vertices against those in double precision",
      .unit = "degrees",
      // 0.01 for the packed code, the rest for float arithmetic.
      .bound = 0.012,
      .advice = kDeformAdvice,
      .quick = true,
      .run = [](KernelLab& lab) {
        return run_deform_cases(lab, [](const DeformedVertices& found, std::size_t v, const DeformedVertex& expected) {
          return turned_degrees(found.frames[v], expected);
        });
      }};
  return {std::move(positions), std::move(directions)};
}

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/grass/reference/kernel_checks.h"

#include <string>
#include <utility>

#include "engine/core/text/formatted.h"
#include "modules/grass/reference/simulation_run.h"
#include "modules/grass/simulation/simulate_blades_pass.h"

namespace gloam {
namespace {

GrassInput blades_in_wind(std::uint32_t iterations) {
  GrassInput input;
  for (const float stiffness : {0.05f, 0.1f, 0.2f, 0.7f, 1.0f, 0.0f}) input.types.push_back(leaning_type(stiffness));
  add_patch(input, 100, 1);
  add_patch(input, 33, 2);
  input.steps.wind = {vec3(6.0f, 0.5f, -3.0f), 0.5f, vec3(3.0f, 0.0f, 200.0f)};
  input.steps.iterations = iterations;
  return input;
}

GrassInput blades_at_colliders() {
  GrassInput input;
  for (const float stiffness : {0.1f, 0.3f}) input.types.push_back(leaning_type(stiffness));
  add_patch(input, 60, 9);
  input.steps.wind = {vec3(0.0f), 1.0f, vec3(0.0f)};
  shaders::GrassCollider capsule{};
  capsule.from_previous = vec3(-0.5f, 0.3f, 0.1f);
  capsule.from = vec3(-0.4f, 0.3f, 0.1f);
  capsule.to_previous = vec3(-0.5f, 1.3f, 0.0f);
  capsule.to = vec3(-0.4f, 1.3f, 0.0f);
  capsule.radius_m = 0.4f;
  add_collider(input, capsule);
  return input;
}

/// Runs frames of these numbers of steps with the kernel that the device gets, and notes the distance from the twin.
Status follow(const KernelLab& lab, GrassInput input, const std::vector<std::uint32_t>& frames,
              const std::string& words, KernelError& error) {
  const SimulationThreads threads = simulation_threads(SimulationThreads::device, lab.device().info().threads_in_turn);
  SimulateTwin twin(input);
  for (const std::uint32_t steps : frames) {
    input.steps.frame_steps = steps;
    twin.advance(input.steps);
    auto output = run_simulation(lab, input, threads);
    if (!output) return output.error();
    take_over(input, std::move(*output));
    error.add(1e3 * twin.distance(input.knots), words);
  }
  return {};
}

Result<KernelError> run_blades(KernelLab& lab) {
  KernelError error;
  for (const std::uint32_t iterations : {1u, 3u, 8u})
    GLOAM_TRY(follow(lab, blades_in_wind(iterations), {1, 2, 3, 1, 2, 3}, formatted("wind, %u iterations", iterations),
                     error));
  GLOAM_TRY(follow(lab, blades_at_colliders(), {8}, "a capsule that moves", error));
  return error;
}

}  // namespace

std::vector<KernelCheck> grass_kernel_checks() {
  return {{.name = "kernel.blades",
           .sentence = "knots of blades in wind and at a collider against the solver in double precision",
           .unit = "mm",
           // Roots are up to 2 m from the patch's origin, where floats lie 2.4e-4 mm apart. Twelve steps of up to 8
           // iterations round knots and add the errors of the device's exp, pow, sin and cos.
           .bound = 0.01,
           .advice = "Set grass.density_scale=0, or another value of grass.group, and report the device",
           .quick = true,
           .run = &run_blades}};
}

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/particles/reference/simulation_run.h"

#include <glm/ext/matrix_transform.hpp>

#include "engine/render/camera/view_constants.h"
#include "engine/render/kernel_check/kernel_run.h"
#include "modules/particles/emitters/rows.h"
#include "modules/particles/sorting/key_ranges.h"
#include "shaders/particles/shaders.h"

namespace gloam {

SimulationRows::SimulationRows() {
  ViewSettings settings;
  settings.width = 320;
  settings.height = 180;
  settings.world_from_camera = glm::inverse(glm::lookAt(dvec3(0.0), dvec3(0.0, -1.0, -6.0), dvec3(0.0, 1.0, 0.0)));
  settings.world_from_camera[3] = dvec4(0.0, 1.0, 6.0, 1.0);
  view = make_view(settings, 0);
}

void SimulationRows::add(const PlacedEmitter& emitter, std::int64_t step) {
  shaders::ParticleEmitterRow row = row_at(emitter, step, view.position, static_cast<std::uint32_t>(places()));
  add_path(emitter, view, step, row, poses);
  row.far_m = 40.0f;
  row.keys = kTwoDigitKeys;
  row.keys_per_m = static_cast<float>(row.keys) / row.far_m;
  groups.insert(groups.end(), (row.count + GLOAM_PARTICLE_GROUP - 1) / GLOAM_PARTICLE_GROUP,
                static_cast<std::uint32_t>(rows.size()));
  rows.push_back(row);
}

shaders::ParticleFrame SimulationRows::frame() const {
  shaders::ParticleFrame frame{};
  for (int i = 0; i < 4; ++i) {
    const Plane& plane = view.frustum.planes[static_cast<std::size_t>(i)];
    frame.planes[i] = vec4(plane.normal, plane.distance);
  }
  frame.near_m = view.near_m;
  frame.places = static_cast<std::uint32_t>(places());
  frame.culled_key = 0xFFFF;
  return frame;
}

Result<ParticleStates> run_particles(const KernelLab& lab, const SimulationRows& rows) {
  KernelRun kernel(lab, shaders::particles::simulate_comp,
                   {{"kOneEmitter", 0u}, {"kPaths", rows.poses.empty() ? 0u : 1u}});
  kernel.push(shaders::ParticleDispatch{});
  kernel.input(0, std::vector{view_constants(rows.view)});
  kernel.input(1, std::vector{rows.frame()});
  kernel.input(2, rows.rows);
  kernel.input(3, rows.groups);
  kernel.input(6, rows.poses.empty() ? std::vector<shaders::ParticlePose>(1) : rows.poses);
  kernel.output(4, rows.places() * sizeof(shaders::Particle));
  kernel.output(5, rows.places() * sizeof(std::uint32_t));
  GLOAM_TRY(kernel.run(static_cast<std::uint32_t>(rows.groups.size())));
  return ParticleStates{kernel.read<shaders::Particle>(4), kernel.read<std::uint32_t>(5)};
}

shaders::ParticleEmitterRow row_at(const PlacedEmitter& emitter, std::int64_t step, const dvec3& eye,
                                   std::uint32_t first) {
  RenderView view;
  view.position = eye;
  VisibleEmitter visible;
  visible.live = live_particles(emitter.rate, static_cast<double>(emitter.values.lifetime_s), step);
  return emitter_row(emitter, visible, {}, {}, view, step, first);
}

dmat4 any_pose(std::mt19937& random) {
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  dmat4 matrix(1.0);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) matrix[i][j] = unit(random);
  matrix[3] = dvec4(10.0 * unit(random), 10.0 * unit(random), 10.0 * unit(random), 1.0);
  return matrix;
}

ParticleEmitter any_emitter(std::mt19937& random, EmitterKind kind) {
  std::uniform_real_distribution<float> unit(0.0f, 1.0f);
  ParticleEmitter values;
  values.kind = kind;
  values.lifetime_s = 0.2f + 8.0f * unit(random);
  values.rate = 200.0f / values.lifetime_s;
  values.size_m = 0.01f + unit(random);
  values.speed = 3.0f * unit(random);
  values.spread = kPi * unit(random);
  values.box_m = vec3(unit(random), 3.0f * unit(random), unit(random));
  return values;
}

}  // namespace gloam

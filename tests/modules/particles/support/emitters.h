// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <glm/ext/matrix_transform.hpp>
#include <random>

#include "engine/render/view.h"
#include "modules/particles/components.h"
#include "modules/particles/emitters/placed.h"
#include "modules/particles/emitters/rows.h"

namespace gloam::test {

inline constexpr EmitterKind kAllKinds[] = {EmitterKind::fog, EmitterKind::dust, EmitterKind::smoke, EmitterKind::fire};

/// An emitter at this pose.
[[nodiscard]] inline PlacedEmitter placed(const ParticleEmitter& values, const dmat4& matrix = dmat4(1.0),
                                          std::uint32_t index = 1) {
  PlacedEmitter emitter;
  EXPECT_TRUE(place_emitter(Entity{index, 1}, values, matrix, emitter));
  return emitter;
}

/// The row of an emitter that a view at `eye` sees, at a step.
[[nodiscard]] inline shaders::ParticleEmitterRow row_at(const PlacedEmitter& emitter, std::int64_t step,
                                                        const dvec3& eye = dvec3(0.0), std::uint32_t first = 0) {
  RenderView view;
  view.position = eye;
  VisibleEmitter visible;
  visible.live = live_particles(emitter.rate, static_cast<double>(emitter.values.lifetime_s), step);
  return emitter_row(emitter, visible, {}, {}, view, step, first);
}

/// A pose with any rotation, scale and shear, near the origin.
[[nodiscard]] inline dmat4 any_pose(std::mt19937& random) {
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  dmat4 matrix(1.0);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) matrix[i][j] = unit(random);
  matrix[3] = dvec4(10.0 * unit(random), 10.0 * unit(random), 10.0 * unit(random), 1.0);
  return matrix;
}

/// An emitter with values from the middle of the ranges of the scene keys.
[[nodiscard]] inline ParticleEmitter any_emitter(std::mt19937& random, EmitterKind kind) {
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

}  // namespace gloam::test

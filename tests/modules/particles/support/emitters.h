// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <glm/ext/matrix_transform.hpp>
#include <random>

#include "modules/particles/components.h"
#include "modules/particles/emitters/placed.h"
#include "modules/particles/emitters/rows.h"
#include "modules/particles/reference/simulation_run.h"

namespace gloam::test {

inline constexpr EmitterKind kAllKinds[] = {EmitterKind::fog, EmitterKind::dust, EmitterKind::smoke, EmitterKind::fire};

/// An emitter at this pose.
[[nodiscard]] inline PlacedEmitter placed(const ParticleEmitter& values, const dmat4& matrix = dmat4(1.0),
                                          std::uint32_t index = 1) {
  PlacedEmitter emitter;
  EXPECT_TRUE(place_emitter(Entity{index, 1}, values, matrix, emitter));
  return emitter;
}

}  // namespace gloam::test

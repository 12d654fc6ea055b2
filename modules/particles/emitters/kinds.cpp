// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/particles/emitters/kinds.h"

#include "engine/core/assert.h"

namespace gloam {
namespace {

// Sprites grow and thin out while they live, so that neither birth nor death shows.
constexpr KindProperties kFog = {.rise = 0.0f,
                                 .drag = 0.4f,
                                 .turbulence = 0.10f,
                                 .swirl_m = 3.0f,
                                 .growth = 1.5f,
                                 .spin = 0.05f,
                                 .opacity = 0.06f,
                                 .fade_in = 0.35f,
                                 .fade_out = 0.5f,
                                 .erosion = 0.6f,
                                 .forward = 0.3f,
                                 .albedo = vec3(0.92f)};
constexpr KindProperties kDust = {.rise = -0.01f,
                                  .drag = 1.5f,
                                  .turbulence = 0.06f,
                                  .swirl_m = 0.7f,
                                  .growth = 1.0f,
                                  .opacity = 0.5f,
                                  .fade_in = 0.2f,
                                  .fade_out = 0.3f,
                                  .erosion = 0.0f,
                                  .forward = 0.0f,
                                  .albedo = vec3(0.9f, 0.86f, 0.8f)};
constexpr KindProperties kSmoke = {.rise = 0.55f,
                                   .drag = 0.9f,
                                   .turbulence = 0.22f,
                                   .swirl_m = 1.1f,
                                   .growth = 4.0f,
                                   .spin = 0.5f,
                                   .opacity = 0.22f,
                                   .fade_in = 0.08f,
                                   .fade_out = 0.75f,
                                   .erosion = 0.75f,
                                   .forward = 0.85f,
                                   .albedo = vec3(0.62f, 0.61f, 0.60f)};
constexpr KindProperties kFire = {.rise = 1.3f,
                                  .drag = 2.5f,
                                  .turbulence = 0.35f,
                                  .swirl_m = 0.35f,
                                  .growth = 0.5f,
                                  .spin = 1.5f,
                                  .opacity = 0.5f,
                                  .fade_in = 0.12f,
                                  .fade_out = 0.85f,
                                  .erosion = 0.9f,
                                  .forward = 0.0f,
                                  .cover = 0.12f,
                                  .albedo = vec3(0.2f),
                                  .emission = vec3(3.6f, 1.25f, 0.2f),
                                  .cooled = vec3(0.55f, 0.2f, 0.06f)};

}  // namespace

const KindProperties& kind_properties(EmitterKind kind) {
  switch (kind) {
    case EmitterKind::fog:
      return kFog;
    case EmitterKind::dust:
      return kDust;
    case EmitterKind::smoke:
      return kSmoke;
    case EmitterKind::fire:
      return kFire;
    case EmitterKind::none:
      break;
  }
  GLOAM_ASSERT(false, "an emitter that emits nothing has no kind");
  return kFog;
}

KindProperties kind_of(const ParticleEmitter& emitter) {
  KindProperties kind = kind_properties(emitter.kind);
  const float units = 1.0f / emitter.metres_per_unit;
  kind.rise *= units;
  kind.turbulence *= units;
  kind.swirl_m *= units;
  return kind;
}

}  // namespace gloam

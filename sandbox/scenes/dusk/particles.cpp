// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <cmath>

#include "engine/scene/resources.h"
#include "modules/fog/components.h"
#include "modules/particles/components.h"
#include "modules/reflections/components.h"
#include "sandbox/scenes/construction/shapes.h"
#include "sandbox/scenes/dusk/parts.h"

namespace gloam {
namespace {

void add_dusk_emitter(Dusk& dusk, const char* name, const dvec3& at, const ParticleEmitter& emitter) {
  dusk.world().add(dusk.builder().add_group(name, at), emitter);
}

/// A basket of iron bars with burning logs.
void add_fire_basket(Dusk& dusk) {
  constexpr vec3 kBasketIron(0.030f, 0.026f, 0.024f);
  Model basket;
  for (int i = 0; i < 12; ++i) {
    const float turn = 2.0f * kPi * static_cast<float>(i) / 12.0f;
    const vec3 out(std::cos(turn), 0.0f, std::sin(turn));
    const vec3 bar[] = {0.2f * out + vec3(0, 0.3f, 0), 0.3f * out + vec3(0, 0.55f, 0), 0.36f * out + vec3(0, 0.86f, 0)};
    const float radii[] = {0.013f, 0.013f, 0.013f};
    basket.tube(kBasketIron, bar, radii, 5);
  }
  const vec2 ring[] = {{0.345f, 0.78f}, {0.365f, 0.78f}, {0.365f, 0.82f}, {0.345f, 0.82f}, {0.345f, 0.78f}};
  const vec2 plate[] = {{0.0f, 0.28f}, {0.22f, 0.28f}, {0.23f, 0.32f}, {0.0f, 0.32f}};
  basket.add(turned_shape(ring, 20), kBasketIron);
  basket.add(turned_shape(plate, 16), kBasketIron);
  for (int i = 0; i < 3; ++i) {
    const float turn = 2.0f * kPi * static_cast<float>(i) / 3.0f + 0.4f;
    const vec3 leg[] = {{0.3f * std::cos(turn), 0.0f, 0.3f * std::sin(turn)},
                        {0.14f * std::cos(turn), 0.3f, 0.14f * std::sin(turn)}};
    const float radii[] = {0.02f, 0.02f};
    basket.tube(kBasketIron, leg, radii, 6);
  }
  const Entity iron = add_dusk_model(dusk, "fire basket", basket, dusk.materials.matt, kDuskFire);
  dusk.world().get<MeshInstance>(iron).casts_shadows = false;  // the light of the fire is among its bars
  Model logs;
  for (int i = 0; i < 6; ++i) {
    const float turn = 1.1f * static_cast<float>(i), y = 0.4f + 0.07f * static_cast<float>(i / 2);
    const vec3 along(0.21f * std::cos(turn), 0.05f, 0.21f * std::sin(turn));
    const vec3 log[] = {vec3(0, y, 0) - along, vec3(0, y, 0) + along};
    const float radii[] = {0.045f, 0.04f};
    logs.tube(vec3(1.0f), log, radii, 7);
  }
  const Entity embers = add_dusk_model(dusk, "embers", logs, dusk.materials.ember, kDuskFire);
  dusk.world().get<MeshInstance>(embers).casts_shadows = false;
}

void add_dusk_fire(Dusk& dusk) {
  add_fire_basket(dusk);
  const dvec3 flames = kDuskFire + dvec3(0.0, 0.55, 0.0);
  add_dusk_emitter(dusk, "fire", flames,
                   {.kind = EmitterKind::fire,
                    .rate = 90.0f,
                    .lifetime_s = 0.95f,
                    .size_m = 0.34f,
                    .speed = 0.6f,
                    .spread = 0.3f,
                    .box_m = vec3(0.34f, 0.06f, 0.34f)});
  add_dusk_emitter(dusk, "smoke of the fire", flames + dvec3(0.0, 0.85, 0.0),
                   {.kind = EmitterKind::smoke,
                    .rate = 16.0f,
                    .lifetime_s = 5.5f,
                    .size_m = 0.26f,
                    .speed = 0.8f,
                    .spread = 0.2f,
                    .box_m = vec3(0.2f, 0.1f, 0.2f)});
  add_dusk_emitter(dusk, "sparks", flames + dvec3(0.0, 0.9, 0.0),
                   {.kind = EmitterKind::dust,
                    .rate = 40.0f,
                    .lifetime_s = 2.4f,
                    .size_m = 0.014f,
                    .speed = 0.9f,
                    .spread = 0.5f,
                    .box_m = vec3(0.4f, 1.0f, 0.4f)});
  add_street_lamp(dusk.street, "fire light",
                  {.color = vec3(1.0f, 0.44f, 0.13f), .candela = 20.0f, .range_m = 7.0f, .width_m = 0.1f},
                  flames + dvec3(0.0, 0.45, 0.0), {0.0, -1.0, 0.0}, true);
}

}  // namespace

void add_dusk_particles(Dusk& dusk) {
  add_dusk_fire(dusk);
  add_dusk_emitter(dusk, "steam of the pot", {3.15, 1.3, -0.94},
                   {.kind = EmitterKind::smoke,
                    .rate = 16.0f,
                    .lifetime_s = 2.6f,
                    .size_m = 0.12f,
                    .speed = 0.35f,
                    .spread = 0.25f,
                    .box_m = vec3(0.2f, 0.02f, 0.2f)});
  for (const dvec3& drain : {dvec3(1.5, 0.05, -10.6), dvec3(-2.6, 0.05, -19.0)})
    add_dusk_emitter(dusk, drain.x > 0.0 ? "steam of a drain" : "steam of a far drain", drain,
                     {.kind = EmitterKind::smoke,
                      .rate = 9.0f,
                      .lifetime_s = 5.0f,
                      .size_m = 0.3f,
                      .speed = 0.25f,
                      .spread = 0.35f,
                      .box_m = vec3(0.4f, 0.02f, 0.4f)});
  add_dusk_emitter(dusk, "fog over the lawn", {12.0, 0.45, -7.0},
                   {.kind = EmitterKind::fog,
                    .rate = 12.0f,
                    .lifetime_s = 14.0f,
                    .size_m = 1.7f,
                    .speed = 0.05f,
                    .spread = kPi,
                    .box_m = vec3(10.0f, 0.3f, 18.0f)});
  dusk.world().add<Fog>(dusk.builder().add_group("haze", dvec3(0.0)),
                        {.density = 0.005f, .color = vec3(0.085f, 0.075f, 0.115f), .sky_distance_m = 30.0f});
}

}  // namespace gloam

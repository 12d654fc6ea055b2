// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <string>

#include "sandbox/scenes/construction/shapes.h"
#include "sandbox/scenes/dusk/parts.h"

namespace gloam {
namespace {

// Local space of a stall: x along its counter, y up from the setts, z towards the customers. Metres.
constexpr float kStallHalf = 1.3f;  // of its width
constexpr float kCounterY = 0.98f;
constexpr vec3 kOak(0.26f, 0.15f, 0.075f), kDarkOak(0.10f, 0.058f, 0.032f), kBread(0.42f, 0.21f, 0.07f);

struct Stall {
  const char* name;
  dvec3 foot;
  vec3 boards;
  vec3 stripe;  ///< between cream
};
constexpr double kStallX = 3.35;
constexpr Stall kStalls[] = {{"baker", {kStallX, 0.0, -1.9}, {0.22f, 0.09f, 0.055f}, {0.42f, 0.04f, 0.035f}},
                             {"fruit", {kStallX, 0.0, -5.2}, {0.07f, 0.13f, 0.085f}, {0.06f, 0.26f, 0.12f}},
                             {"lanterns", {kStallX, 0.0, -8.5}, {0.075f, 0.085f, 0.16f}, {0.10f, 0.14f, 0.40f}}};

void add_frame(Model& model, const Stall& stall) {
  model.box(stall.boards, {-kStallHalf, 0.0f, -0.1f}, {kStallHalf, kCounterY - 0.06f, 0.52f});
  for (int i = 0; i < 8; ++i) {
    const float x = -kStallHalf + 0.325f * static_cast<float>(i) + 0.16f;
    model.box(stall.boards * 0.6f, {x - 0.008f, 0.05f, 0.51f}, {x + 0.008f, kCounterY - 0.06f, 0.524f});
  }
  model.box(kOak, {-kStallHalf - 0.06f, kCounterY - 0.06f, -0.16f}, {kStallHalf + 0.06f, kCounterY, 0.62f});
  for (const float side : {-1.0f, 1.0f}) {
    const float x = side * (kStallHalf + 0.02f);
    model.box(kDarkOak, {x - 0.04f, 0.0f, 0.5f}, {x + 0.04f, 2.3f, 0.58f});
    model.box(kDarkOak, {x - 0.04f, 0.0f, -0.98f}, {x + 0.04f, 2.62f, -0.9f});
    model.box(stall.boards * 0.8f, {x - 0.015f, 0.1f, -0.9f}, {x + 0.015f, 1.1f, 0.5f});
  }
  model.box(stall.boards * 0.75f, {-kStallHalf, 0.1f, -0.97f}, {kStallHalf, 2.05f, -0.93f});
  model.box(kOak, {-kStallHalf + 0.05f, 1.35f, -0.93f}, {kStallHalf - 0.05f, 1.39f, -0.7f});
  model.box(kOak, {-kStallHalf + 0.05f, 1.75f, -0.93f}, {kStallHalf - 0.05f, 1.79f, -0.7f});
  model.box(kDarkOak, {-kStallHalf, 2.27f, 0.5f}, {kStallHalf, 2.33f, 0.58f});
}

/// Jars on the shelves behind the counter.
void add_jars(Model& model, std::uint32_t seed) {
  const vec2 jar[] = {{0.0f, 0.0f}, {0.075f, 0.0f}, {0.08f, 0.13f}, {0.05f, 0.17f}, {0.055f, 0.2f}, {0.0f, 0.21f}};
  const Primitive shape = turned_shape(jar, 9);
  for (std::uint32_t i = 0; i < 20; ++i) {
    const float x = -1.1f + 0.235f * static_cast<float>(i % 10), y = i < 10 ? 1.39f : 1.79f;
    if (dusk_scatter(i, seed) < 0.15f) continue;
    const vec3 color(0.12f + 0.5f * dusk_scatter(i, seed + 1u), 0.10f + 0.25f * dusk_scatter(i, seed + 2u),
                     0.05f + 0.14f * dusk_scatter(i, seed + 3u));
    const float size = 0.8f + 0.4f * dusk_scatter(i, seed + 4u);
    model.add(shape, color, glm::scale(glm::translate(mat4(1.0f), {x, y, -0.82f}), vec3(size)));
  }
}

/// An awning of stripes, with a scalloped edge.
Model awning(const Stall& stall) {
  constexpr int kStripes = 12;
  constexpr vec3 kCream(0.40f, 0.33f, 0.22f);
  Model cloth;
  for (int i = 0; i < kStripes; ++i) {
    const float x0 = -1.48f + 2.96f * static_cast<float>(i) / kStripes, x1 = x0 + 2.96f / kStripes,
                m = 0.5f * (x0 + x1);
    const vec3 color = i % 2 == 0 ? stall.stripe : kCream;
    cloth.quad(color, {x0, 2.24f, 1.18f}, {x1, 2.24f, 1.18f}, {x1, 2.5f, 0.2f}, {x0, 2.5f, 0.2f});
    cloth.quad(color, {x0, 2.5f, 0.2f}, {x1, 2.5f, 0.2f}, {x1, 2.66f, -1.05f}, {x0, 2.66f, -1.05f});
    cloth.quad(color, {x0, 2.12f, 1.19f}, {x1, 2.12f, 1.19f}, {x1, 2.24f, 1.18f}, {x0, 2.24f, 1.18f});
    cloth.quad(color, {m - 0.03f, 2.04f, 1.195f}, {m + 0.03f, 2.04f, 1.195f}, {x1, 2.12f, 1.19f}, {x0, 2.12f, 1.19f});
  }
  return cloth;
}

void add_bakery(Model& model) {
  model.box(kDarkOak, {-1.06f, kCounterY, 0.12f}, {0.14f, kCounterY + 0.1f, 0.33f});
  for (std::uint32_t i = 0; i < 14; ++i) {  // loaves on the counter, and behind them on a step
    const float x = -0.96f + 0.16f * static_cast<float>(i % 7), y = kCounterY + (i < 7 ? 0.05f : 0.15f);
    const vec3 crust = kBread * (0.75f + 0.5f * dusk_scatter(i, 3u));
    model.ball(crust, {x, y, (i < 7 ? 0.43f : 0.22f) + 0.02f * dusk_scatter(i, 4u)}, {0.07f, 0.055f, 0.09f}, 10);
  }
  const vec2 pot[] = {{0.0f, 0.0f},    {0.2f, 0.0f},  {0.22f, 0.04f}, {0.22f, 0.3f}, {0.235f, 0.31f},
                      {0.235f, 0.33f}, {0.2f, 0.33f}, {0.19f, 0.28f}, {0.0f, 0.28f}};
  model.add(turned_shape(pot, 20), vec3(0.10f, 0.045f, 0.025f), vec3(0.96f, kCounterY, 0.2f));
  const vec2 cup[] = {{0.0f, 0.0f}, {0.036f, 0.0f}, {0.044f, 0.1f}, {0.04f, 0.1f}, {0.035f, 0.02f}, {0.0f, 0.02f}};
  for (int i = 0; i < 4; ++i)
    model.add(turned_shape(cup, 10), vec3(0.55f, 0.5f, 0.42f),
              vec3(0.58f + 0.1f * static_cast<float>(i % 2), kCounterY, 0.3f + 0.12f * static_cast<float>(i / 2)));
  model.box(kDarkOak, {0.18f, kCounterY, 0.28f}, {0.46f, kCounterY + 0.02f, 0.56f});
  for (int i = 0; i < 3; ++i)
    model.ball(vec3(0.5f, 0.3f, 0.12f), {0.26f + 0.06f * static_cast<float>(i), kCounterY + 0.05f, 0.42f},
               {0.05f, 0.035f, 0.05f}, 10);
}

void add_fruit(Model& model) {
  constexpr std::array<vec3, 4> kColors = {
      {{0.62f, 0.26f, 0.03f}, {0.52f, 0.05f, 0.035f}, {0.30f, 0.42f, 0.06f}, {0.66f, 0.46f, 0.06f}}};
  for (int crate = 0; crate < 4; ++crate) {
    const float x = -0.96f + 0.64f * static_cast<float>(crate);
    const mat4 tilt = glm::rotate(glm::translate(mat4(1.0f), {x, kCounterY + 0.02f, 0.24f}), 0.32f, vec3(1, 0, 0));
    model.add(box_shape({0.58f, 0.1f, 0.56f}), kOak, tilt);
    const float r = 0.052f;
    const Primitive ball = sphere_shape(r, 8);
    for (int row = 0; row < 4; ++row)
      for (int column = 0; column < 5; ++column) {
        const auto number = static_cast<std::uint32_t>(crate * 40 + row * 5 + column);
        const vec3 at(-0.22f + 0.11f * static_cast<float>(column), 0.12f + 0.03f * dusk_scatter(number, 1u),
                      -0.2f + 0.13f * static_cast<float>(row));
        model.add(ball, kColors[static_cast<std::size_t>(crate)] * (0.8f + 0.4f * dusk_scatter(number, 2u)),
                  tilt * glm::translate(mat4(1.0f), at));
      }
  }
}

/// Candles and small boxes; paper lanterns hang before them (lights.cpp).
void add_candles(Model& model) {
  const vec2 candle[] = {{0.0f, 0.0f}, {0.035f, 0.0f}, {0.032f, 1.0f}, {0.0f, 1.0f}};
  for (std::uint32_t i = 0; i < 11; ++i) {
    const float height = 0.1f + 0.16f * dusk_scatter(i, 5u);
    const vec3 at(-1.05f + 0.21f * static_cast<float>(i), kCounterY, 0.25f + 0.22f * dusk_scatter(i, 6u));
    const vec3 color = i % 3 == 0 ? vec3(0.5f, 0.08f, 0.06f) : vec3(0.6f, 0.5f, 0.32f);
    model.add(turned_shape(candle, 8), color, glm::scale(glm::translate(mat4(1.0f), at), vec3(1.2f, height, 1.2f)));
  }
}

/// A glass bell over the cakes.
void add_glass_bell(Dusk& dusk, const dvec3& at) {
  const vec2 bell[] = {{0.15f, 0.0f}, {0.15f, 0.12f}, {0.11f, 0.21f}, {0.03f, 0.245f}, {0.02f, 0.27f}, {0.0f, 0.29f}};
  Model glass;
  glass.add(rounded_shape(bell, 20), vec3(0.9f, 0.95f, 1.0f));
  const Entity entity = add_dusk_model(dusk, "glass bell", glass, dusk.materials.glass, at);
  dusk.world().get<MeshInstance>(entity).casts_shadows = false;
}

}  // namespace

void add_dusk_stalls(Dusk& dusk) {
  constexpr double kToStreet = -0.5 * kPi;  // faces −X
  Model bulb;
  bulb.ball(vec3(1.0f), vec3(0.0f), vec3(0.05f), 10);
  std::uint32_t seed = 40;
  for (const Stall& stall : kStalls) {
    Model model;
    add_frame(model, stall);
    add_jars(model, seed += 10);
    const std::string name = stall.name;
    if (name == "baker") add_bakery(model);
    if (name == "fruit") add_fruit(model);
    if (name == "lanterns") add_candles(model);
    add_dusk_model(dusk, "stall " + name, model, dusk.materials.matt, stall.foot, kToStreet);
    add_dusk_model(dusk, "awning " + name, awning(stall), dusk.materials.canvas, stall.foot, kToStreet);
    add_street_proxy(dusk.street, "stall " + name, stall.foot + dvec3(-1.22, 1.3, 0.0), {-1.0, 0.0, 0.0}, {2.9f, 2.6f});
    // A lamp below the awning lights goods and keeper, and shines through the cloth.
    add_street_lamp(dusk.street, "stall lamp " + name,
                    {.color = kDuskWarm, .candela = 9.0f, .range_m = 4.2f, .width_m = 0.05f},
                    stall.foot + dvec3(-0.45, 2.12, 0.0), {0.0, -1.0, 0.0}, true);
    add_dusk_model(dusk, "stall bulb " + name, bulb, dusk.materials.bulb, stall.foot + dvec3(-0.45, 2.12, 0.0));
  }
  add_glass_bell(dusk, kStalls[0].foot + dvec3(-0.42, double{kCounterY} + 0.02, 0.32));
}

}  // namespace gloam

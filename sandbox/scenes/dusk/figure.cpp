// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/scenes/dusk/figure.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "sandbox/scenes/construction/shapes.h"

namespace gloam {
namespace {

constexpr vec3 kSkin(0.50f, 0.30f, 0.21f), kShoe(0.025f, 0.018f, 0.014f), kDark(0.012f);
constexpr vec3 kHead(0.0f, 1.595f, 0.015f);

/// The number of sides of a part that has n of them in a figure of full detail.
std::uint32_t sides_of(const FigureLook& look, float n) {
  return std::max(5u, static_cast<std::uint32_t>(std::lround(n * look.detail)));
}

void add_coat(Model& model, const FigureLook& look) {
  const float hem = look.hem_m;
  const vec2 outline[] = {{0.0f, hem + 0.03f}, {0.215f, hem},  {0.212f, hem + 0.05f}, {0.185f, 0.88f},
                          {0.168f, 1.04f},     {0.20f, 1.24f}, {0.215f, 1.34f},       {0.17f, 1.425f},
                          {0.085f, 1.47f},     {0.065f, 1.52f}};
  model.add(rounded_shape(outline, sides_of(look, 16.0f)), look.coat, glm::scale(mat4(1.0f), vec3(1.0f, 1.0f, 0.70f)));
  // Belt, front edge and buttons.
  const vec2 belt[] = {{0.17f, 1.02f}, {0.181f, 1.025f}, {0.181f, 1.065f}, {0.17f, 1.07f}};
  model.add(turned_shape(belt, sides_of(look, 14.0f)), look.coat * 0.4f,
            glm::scale(mat4(1.0f), vec3(1.0f, 1.0f, 0.71f)));
  for (const float y : {1.32f, 1.2f, 0.94f, 0.8f}) {
    if (look.apron != vec3(0.0f)) break;  // they would stand out of it
    model.ball(look.coat * 0.25f, {0.03f, y, y > 1.05f ? 0.145f : 0.128f}, vec3(0.014f), sides_of(look, 6.0f));
  }
  if (look.apron != vec3(0.0f)) {
    const vec2 apron[] = {{0.229f, hem + 0.02f}, {0.2f, 0.88f}, {0.186f, 1.03f}, {0.212f, 1.22f}, {0.217f, 1.3f}};
    Primitive front = rounded_shape(apron, sides_of(look, 24.0f));
    std::erase_if(front.indices, [&, corner = 0u, drop = false](std::uint32_t index) mutable {
      if (corner++ % 3 == 0) drop = front.positions[index].z < 0.11f;
      return drop;
    });
    model.add(front, look.apron, glm::scale(mat4(1.0f), vec3(1.0f, 1.0f, 0.73f)));
  }
  // Collar.
  const vec2 collar[] = {{0.105f, 1.43f}, {0.125f, 1.47f}, {0.118f, 1.54f}, {0.10f, 1.545f}, {0.095f, 1.45f}};
  model.add(rounded_shape(collar, sides_of(look, 12.0f)), look.coat * 0.8f,
            glm::scale(mat4(1.0f), vec3(1.0f, 1.0f, 0.85f)));
}

void add_arms(Model& model, const FigureLook& look) {
  for (std::size_t i = 0; i < 2; ++i) {
    const float side = i == 0 ? 1.0f : -1.0f;
    const vec3 shoulder(side * 0.185f, 1.375f, -0.005f), elbow = look.elbows[i], hand = look.hands[i];
    const vec3 line[] = {shoulder, glm::mix(shoulder, elbow, 0.5f) + vec3(side * 0.015f, 0.0f, 0.0f), elbow,
                         glm::mix(elbow, hand, 0.86f)};
    const float radii[] = {0.066f, 0.062f, 0.054f, 0.046f};
    model.tube(look.coat * 0.94f, line, radii, sides_of(look, 8.0f));
    model.ball(look.coat * 0.94f, shoulder, vec3(0.068f), sides_of(look, 8.0f));
    model.ball(look.coat * 0.94f, elbow, vec3(0.054f), sides_of(look, 8.0f));
    model.ball(kSkin, hand, {0.04f, 0.045f, 0.045f}, sides_of(look, 8.0f));
    const vec3 to_hand = glm::normalize(hand - elbow);
    model.ball(kSkin, hand + 0.035f * to_hand + vec3(-side * 0.02f, 0.01f, 0.0f), vec3(0.022f), sides_of(look, 6.0f));
  }
}

void add_head(Model& model, const FigureLook& look) {
  const vec3 neck[] = {{0.0f, 1.45f, -0.01f}, {0.0f, 1.56f, 0.0f}};
  const float neck_radii[] = {0.06f, 0.052f};
  model.tube(kSkin, neck, neck_radii, sides_of(look, 10.0f));
  model.ball(kSkin, kHead, {0.083f, 0.112f, 0.097f}, sides_of(look, 14.0f));
  model.ball(kSkin, kHead + vec3(0.0f, -0.055f, 0.03f), {0.055f, 0.055f, 0.065f}, sides_of(look, 8.0f));  // jaw
  model.ball(kSkin * 0.95f, kHead + vec3(0.0f, -0.012f, 0.098f), {0.013f, 0.022f, 0.02f}, sides_of(look, 6.0f));
  for (const float side : {-1.0f, 1.0f}) {
    model.ball(kDark, kHead + vec3(side * 0.033f, 0.018f, 0.084f), {0.008f, 0.008f, 0.007f}, sides_of(look, 6.0f));
    model.ball(kSkin, kHead + vec3(side * 0.083f, -0.005f, -0.005f), {0.014f, 0.026f, 0.018f}, sides_of(look, 6.0f));
  }
  model.ball(look.hair, kHead + vec3(0.0f, 0.024f, -0.034f), {0.090f, 0.100f, 0.090f}, sides_of(look, 12.0f));
}

void add_headwear(Model& model, const FigureLook& look) {
  const mat4 at = glm::translate(mat4(1.0f), kHead);
  if (look.headwear == Headwear::hair) {
    model.ball(look.hair, kHead + vec3(0.0f, 0.075f, -0.085f), vec3(0.05f), sides_of(look, 10.0f));  // a bun
  } else if (look.headwear == Headwear::cap) {
    const vec2 cap[] = {{0.104f, 0.03f}, {0.108f, 0.06f}, {0.104f, 0.10f}, {0.07f, 0.145f}, {0.0f, 0.16f}};
    model.add(rounded_shape(cap, sides_of(look, 14.0f)), look.head_color,
              at * glm::scale(mat4(1.0f), vec3(0.95f, 1.0f, 1.05f)));
    const vec2 cuff[] = {{0.104f, 0.015f}, {0.116f, 0.03f}, {0.116f, 0.055f}, {0.104f, 0.07f}};
    model.add(rounded_shape(cuff, sides_of(look, 14.0f)), look.head_color * 0.7f,
              at * glm::scale(mat4(1.0f), vec3(0.95f, 1.0f, 1.05f)));
    model.ball(look.head_color * 1.3f, kHead + vec3(0.0f, 0.175f, 0.0f), vec3(0.034f), sides_of(look, 8.0f));
  } else if (look.headwear == Headwear::hat) {
    const vec2 hat[] = {{0.0f, 0.045f},  {0.18f, 0.042f},  {0.187f, 0.052f}, {0.115f, 0.062f},
                        {0.104f, 0.07f}, {0.098f, 0.145f}, {0.08f, 0.175f},  {0.0f, 0.165f}};
    model.add(rounded_shape(hat, sides_of(look, 14.0f)), look.head_color, at);
    const vec2 band[] = {{0.106f, 0.068f}, {0.106f, 0.092f}};
    model.add(turned_shape(band, sides_of(look, 14.0f)), look.head_color * 0.3f, at);
  } else {
    model.ball(look.head_color, kHead + vec3(0.0f, 0.012f, -0.03f), {0.112f, 0.135f, 0.112f}, sides_of(look, 14.0f));
  }
}

void add_scarf(Model& model, const FigureLook& look) {
  if (look.scarf == vec3(0.0f)) return;
  const vec2 ring[] = {{0.09f, 1.435f}, {0.135f, 1.455f}, {0.14f, 1.495f}, {0.125f, 1.535f}, {0.08f, 1.54f}};
  model.add(rounded_shape(ring, sides_of(look, 12.0f)), look.scarf, glm::scale(mat4(1.0f), vec3(1.0f, 1.0f, 0.92f)));
  const vec3 end[] = {{0.05f, 1.47f, 0.12f}, {0.065f, 1.36f, 0.165f}, {0.07f, 1.08f, 0.155f}};
  const float radii[] = {0.035f, 0.038f, 0.045f};
  model.tube(look.scarf * 0.85f, end, radii, sides_of(look, 8.0f));
}

void add_umbrella(Model& model, const FigureLook& look) {
  const vec3 hand = look.hands[1];
  const vec3 stick[] = {hand + vec3(0.0f, -0.12f, 0.0f), hand + vec3(0.02f, 1.06f, -0.06f)};
  const float radii[] = {0.011f, 0.009f};
  model.tube(vec3(0.05f), stick, radii, sides_of(look, 6.0f));
  const vec2 canopy[] = {{0.0f, -0.045f},  {0.22f, -0.075f}, {0.42f, -0.165f}, {0.555f, -0.305f}, {0.56f, -0.30f},
                         {0.43f, -0.148f}, {0.22f, -0.052f}, {0.02f, 0.0f},    {0.008f, 0.06f},   {0.0f, 0.06f}};
  model.add(turned_shape(canopy, 10), look.umbrella,
            glm::rotate(glm::translate(mat4(1.0f), stick[1]), -0.05f, vec3(1, 0, 0)));
}

}  // namespace

Model figure_body(const FigureLook& look) {
  Model model;
  add_coat(model, look);
  add_arms(model, look);
  add_head(model, look);
  add_headwear(model, look);
  add_scarf(model, look);
  if (look.has_umbrella) add_umbrella(model, look);
  return model;
}

Model figure_leg(const FigureLook& look) {
  Model leg;
  const vec3 line[] = {{0.0f, 0.0f, 0.0f}, {0.0f, -0.4f, 0.015f}, {0.0f, -0.79f, 0.0f}};
  const float radii[] = {0.085f, 0.064f, 0.052f};
  leg.tube(look.trousers, line, radii, sides_of(look, 10.0f));
  leg.ball(kShoe, {0.0f, -0.815f, 0.045f}, {0.05f, 0.045f, 0.125f}, sides_of(look, 8.0f));
  return leg;
}

void add_figure_legs(Model& model, const FigureLook& look) {
  const Model leg = figure_leg(look);
  for (const float side : {-1.0f, 1.0f}) {
    const mat4 pose = glm::rotate(glm::translate(mat4(1.0f), {side * 0.095f, static_cast<float>(kFigureHip_m), 0.0f}),
                                  side * 0.06f, vec3(0, 0, 1));
    model.add(leg.shape(), vec3(1.0f), pose);
  }
}

}  // namespace gloam

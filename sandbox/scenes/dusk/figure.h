// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>

#include "sandbox/scenes/dusk/model.h"

namespace gloam {

enum class Headwear { hair, cap, hat, hood };

/// A person, 1.72 m tall, who faces +Z with the feet at the origin.
struct FigureLook {
  float detail = 1.0f;  ///< factor of the numbers of sides: 0.5 for people who are never near a camera
  vec3 coat = vec3(0.1f);
  vec3 trousers = vec3(0.03f);
  vec3 hair = vec3(0.05f, 0.03f, 0.02f);
  vec3 head_color = vec3(0.1f);  ///< of the cap, hat or hood
  vec3 scarf = vec3(0.0f);       ///< black: none
  vec3 apron = vec3(0.0f);       ///< black: none
  Headwear headwear = Headwear::hair;
  float hem_m = 0.55f;  ///< height of the coat's lower edge
  bool has_umbrella = false;
  vec3 umbrella = vec3(0.1f);
  /// Elbows and hands, left (+X) before right.
  std::array<vec3, 2> elbows = {vec3(0.29f, 1.12f, -0.02f), vec3(-0.29f, 1.12f, -0.02f)};
  std::array<vec3, 2> hands = {vec3(0.28f, 0.87f, 0.07f), vec3(-0.28f, 0.87f, 0.07f)};
};

/// All of it but the legs.
[[nodiscard]] Model figure_body(const FigureLook& look);
/// Both legs, standing.
void add_figure_legs(Model& model, const FigureLook& look);
/// One leg, which hangs from its hip at the origin.
[[nodiscard]] Model figure_leg(const FigureLook& look);
inline constexpr double kFigureHip_m = 0.86;

}  // namespace gloam

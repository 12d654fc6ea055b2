// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/play/input/orbit_controls.h"

#include <algorithm>
#include <cmath>

namespace gloam {
namespace {

constexpr double kOrbitRadiansPerPixel = 0.005;
constexpr double kFactorPerStep = 0.85;  // of the wheel
constexpr double kDistance = 5.0;        // metres, of a pivot where nothing is seen

}  // namespace

std::optional<uvec2> pixel_at(const ViewSettings& view, const WindowPlace& place) {
  if (!(place.x >= 0.0 && place.y >= 0.0 && place.x < view.width && place.y < view.height)) return std::nullopt;
  const auto scaled = [&](double at, std::uint32_t size) {
    const double last = std::max(std::round(size * place.scale) - 1.0, 0.0);
    return static_cast<std::uint32_t>(std::min(at * place.scale, last));
  };
  return uvec2(scaled(place.x, view.width), scaled(place.y, view.height));
}

Status OrbitControls::take_pivot(const ViewSettings& view, const WindowPlace& place) {
  if (const auto pixel = pixel_at(view, place)) {
    const auto position = session_.renderer->pick_position(session_.world, view.id, pixel->x, pixel->y);
    if (!position.ok()) return position.error();
    if (*position) pivot_ = **position;
  }
  if (!pivot_) {
    ViewSettings camera = view;
    if (camera.follow_camera) follow_camera(session_.world, camera);
    pivot_ = dvec3(camera.world_from_camera * dvec4(0.0, 0.0, -kDistance, 1.0));
  }
  return {};
}

Status OrbitControls::add(const WindowInput& input, const ViewSettings& view, double scale, FlyInput& flight) {
  const bool orbits = input.orbit_x != 0.0 || input.orbit_y != 0.0;
  const bool picks = input.grabbed || input.look_at;
  if (!picks && !orbits && input.wheel == 0.0) return {};
  if (picks) GLOAM_TRY(take_pivot(view, {input.pointer_x, input.pointer_y, scale}));
  if (!pivot_) GLOAM_TRY(take_pivot(view, {0.5 * view.width, 0.5 * view.height, scale}));
  flight.pivot = *pivot_;
  flight.orbit_turn = -input.orbit_x * kOrbitRadiansPerPixel;
  flight.orbit_tilt = input.orbit_y * kOrbitRadiansPerPixel;
  flight.approach = std::pow(kFactorPerStep, input.wheel);
  flight.look_at_pivot = input.look_at;
  return {};
}

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/bake/proxy_capture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <utility>
#include <vector>

#include "modules/reflections/bake/capture_view.h"
#include "modules/reflections/scene_unit.h"

namespace gloam {
namespace {

constexpr double kNear = 0.1;               // scene_unit()s between the eye and the near side of the capture
constexpr std::uint32_t kPixelsATexel = 2;  // in each direction, against jagged edges

/// The direction that is up in the view of a proxy.
dvec3 up_of(const PlacedProxy& proxy) { return glm::cross(proxy.normal, glm::normalize(proxy.half_u)); }

/// A mirrored node has its +Y where the view has its lower side.
bool is_upside_down(const PlacedProxy& proxy) { return glm::dot(proxy.half_v, up_of(proxy)) < 0.0; }

void turn_upside_down(CapturedPicture& picture) {
  for (std::uint32_t y = 0; y < picture.height / 2; ++y) {
    const auto row = picture.texels.begin() + std::ptrdiff_t{y} * picture.width;
    std::swap_ranges(row, row + picture.width,
                     picture.texels.begin() + std::ptrdiff_t{picture.height - 1 - y} * picture.width);
  }
}

}  // namespace

ViewSettings proxy_view(const PlacedProxy& proxy, std::uint32_t side, double unit_m) {
  const dvec3 x = glm::normalize(proxy.half_u), y = up_of(proxy);
  const double half_width = glm::length(proxy.half_u), half_height = std::abs(glm::dot(proxy.half_v, y));
  const double longer = 2.0 * std::max(half_width, half_height);
  const double before = std::clamp(0.1 * longer, 0.25 * unit_m, unit_m);
  const double behind = std::clamp(0.25 * longer, unit_m, 4.0 * unit_m), near = kNear * unit_m;
  ViewSettings settings = capture_view(0);
  settings.width = settings.height = side;
  settings.exact_width = true;
  settings.camera.orthographic = true;
  settings.camera.half_width_m = static_cast<float>(half_width);
  settings.camera.half_height_m = static_cast<float>(half_height);
  settings.camera.near_m = static_cast<float>(near);
  settings.camera.far_m = static_cast<float>(near + before + behind);
  const dvec3 eye = proxy.center + (before + near) * proxy.normal;
  settings.world_from_camera = dmat4(dvec4(x, 0.0), dvec4(y, 0.0), dvec4(proxy.normal, 0.0), dvec4(eye, 1.0));
  return settings;
}

Result<CapturedPicture> capture_proxy(Renderer& renderer, World& world, const PlacedProxy& proxy, std::uint32_t side,
                                      float light_scale) {
  // read_image() draws a view again, so depth is read from a view without light.
  std::array<ViewRequest, 2> requests;
  ViewSettings &lit = requests[0].settings, &unlit = requests[1].settings;
  lit = unlit = proxy_view(proxy, kPixelsATexel * side, scene_unit(world));
  unlit.id = capture_view(1).id;
  for (const auto& module : renderer.modules()) unlit.without.emplace_back(module->name());
  GLOAM_TRY(renderer.render(world, requests));
  const auto light = renderer.read_linear(lit.id);
  if (!light.ok()) return light.error();
  const auto depth = renderer.read_image(world, unlit.id, "depth");
  if (!depth.ok()) return depth.error();

  CapturedPicture picture{light->width, light->height, {}};
  picture.texels.resize(std::size_t{picture.width} * picture.height, vec4(0.0f));
  for (std::size_t i = 0; i < picture.texels.size(); ++i) {
    float pixel_depth = 0.0f;
    std::memcpy(&pixel_depth, depth->bytes.data() + i * sizeof(float), sizeof(float));
    if (!(pixel_depth > 0.0f)) continue;
    const float* const rgba = &light->rgba[4 * i];
    picture.texels[i] = vec4(storable(light_scale * vec3(rgba[0], rgba[1], rgba[2])), 1.0f);
  }
  if (is_upside_down(proxy)) turn_upside_down(picture);
  return resampled(picture, side);
}

}  // namespace gloam

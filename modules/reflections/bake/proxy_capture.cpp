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

/// The light where a surface was met, at the proxy's size.
CapturedPicture covered_picture(const PlacedProxy& proxy, const LinearPicture& light, const std::vector<float>& depth,
                                std::uint32_t side, float light_scale) {
  CapturedPicture picture{light.width, light.height, {}};
  picture.texels.resize(std::size_t{picture.width} * picture.height, vec4(0.0f));
  for (std::size_t i = 0; i < picture.texels.size(); ++i) {
    if (!(depth[i] > 0.0f)) continue;
    const float* const rgba = &light.rgba[4 * i];
    picture.texels[i] = vec4(storable(light_scale * vec3(rgba[0], rgba[1], rgba[2])), 1.0f);
  }
  if (is_upside_down(proxy)) turn_upside_down(picture);
  return resampled(picture, side);
}

/// CapturedParts::surface_m; 0 if no surface was met.
float mean_surface(const PlacedProxy& proxy, const ViewSettings& settings, const std::vector<float>& depth) {
  const RenderView view = make_view(settings, 0);
  const double before = glm::dot(proxy.normal, dvec3(settings.world_from_camera[3]) - proxy.center);
  double sum = 0.0, count = 0.0;
  for (const float value : depth) {
    if (!(value > 0.0f)) continue;
    sum += before - static_cast<double>(view.view_depth(value));
    count += 1.0;
  }
  return count > 0.0 ? static_cast<float>(sum / count) : 0.0f;
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

Result<ProxyCapture> capture_proxy(Renderer& renderer, World& world, const PlacedProxy& proxy, std::uint32_t side,
                                   float light_scale) {
  // read_image() draws a view again, so depth is read from a view without shading.
  std::array<ViewRequest, 3> requests;
  ViewSettings &all = requests[0].settings, &unlit = requests[1].settings, &depths = requests[2].settings;
  all = unlit = depths = proxy_view(proxy, kPixelsATexel * side, scene_unit(world));
  leave_lights_out(unlit);
  depths.id = capture_view(1).id;
  for (const auto& module : renderer.modules())
    if (module->name() != "grass") depths.without.emplace_back(module->name());
  GLOAM_TRY(renderer.render(world, requests));
  const auto light = renderer.read_linear(all.id), unlit_light = renderer.read_linear(unlit.id);
  if (!light.ok()) return light.error();
  if (!unlit_light.ok()) return unlit_light.error();
  const auto depth = renderer.read_image(world, depths.id, "depth");
  if (!depth.ok()) return depth.error();
  std::vector<float> device_depth(depth->bytes.size() / sizeof(float));
  std::memcpy(device_depth.data(), depth->bytes.data(), device_depth.size() * sizeof(float));

  ProxyCapture capture;
  capture.surface_m = mean_surface(proxy, all, device_depth);
  capture.all = covered_picture(proxy, *light, device_depth, side, light_scale);
  capture.unlit = covered_picture(proxy, *unlit_light, device_depth, side, light_scale);
  return capture;
}

}  // namespace gloam

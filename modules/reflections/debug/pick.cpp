// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/debug/pick.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "engine/core/text/formatted.h"
#include "engine/math/packing.h"
#include "engine/render/camera/view_constants.h"
#include "engine/render/outputs.h"
#include "engine/render/readback/geometry_picture.h"
#include "engine/scene/resources.h"
#include "modules/lighting/outputs.h"
#include "modules/reflections/culling/placed.h"
#include "modules/reflections/culling/rooms.h"
#include "modules/reflections/culling/tiles.h"
#include "modules/reflections/frame.h"

namespace gloam {
namespace {

constexpr const char* kScreenCopy = "reflections.screen_space";
constexpr const char* kColorCopy = "reflections.color";
constexpr const char* kSurfaceCopy = "reflections.surface";

float alpha_of(const Captures& copies, const char* copy, std::size_t texel) {
  return half_to_float(static_cast<std::uint16_t>(copies.item<uvec2>(copy, texel).y >> 16));
}

struct MetProxy {
  std::size_t index = 0;  ///< of ProxySet::proxies
  double distance_m = 0.0;
};

/// Whether the view shows the proxy in receivers at this world height.
bool serves_height(const ProxySet& set, const ProxyTiles& tiles, const PlacedProxy& proxy, const dvec3& camera,
                   double height) {
  return std::ranges::any_of(receiver_bands(proxy, set.rooms, tiles.rooms, camera, set.unit).all(),
                             [&](const ReceiverBand& b) { return b.lowest_m <= height && height <= b.highest_m; });
}

/// The nearest proxy whose front a ray meets, of those that have an image, are not dark and serve the origin's height.
std::optional<MetProxy> nearest_proxy(const ReflectionPlan& plan, const ProxySet& set, const ProxyTiles& tiles,
                                      const dvec3& camera, const dvec3& origin, const dvec3& direction) {
  std::optional<MetProxy> nearest;
  for (std::size_t row = 0; row < plan.proxies.size(); ++row) {
    const std::size_t index = plan.knobs.naive ? row : tiles.proxies[row];
    const PlacedProxy& proxy = set.proxies[index];
    const double facing = glm::dot(proxy.normal, direction);
    if (facing >= 0.0 || !(plan.proxies[row].opacity > 0.0f)) continue;
    if (!serves_height(set, tiles, proxy, camera, origin.y)) continue;
    const double distance_m = glm::dot(proxy.normal, proxy.center - origin) / facing;
    if (distance_m <= 0.0 || (nearest && nearest->distance_m <= distance_m)) continue;
    const dvec3 offset = origin + direction * distance_m - proxy.center;
    const double u = glm::dot(offset, proxy.half_u) / glm::dot(proxy.half_u, proxy.half_u);
    const double v = glm::dot(offset, proxy.half_v) / glm::dot(proxy.half_v, proxy.half_v);
    if (std::abs(u) <= 1.0 && std::abs(v) <= 1.0) nearest = MetProxy{index, distance_m};
  }
  return nearest;
}

std::string proxy_line(const FrameBuilder& frame, const ReflectionPlan& plan, const PickedPixel& pixel) {
  if (!plan.knobs.proxies) return "proxy: the view has no proxies";
  const RenderView& view = frame.view();
  const dvec3 position = view.position + surface_position(view, pixel.x, pixel.y, pixel.depth);
  const dvec3 seen =
      glm::normalize(view.camera.orthographic ? dvec3(-view_constants(view).view_row_z) : position - view.position);
  const auto& set = frame.world().resource<ProxySet>();
  const auto met = nearest_proxy(plan, set, frame.world().view_resource<ProxyTiles>(view.id), view.position, position,
                                 dvec3(seen.x, -seen.y, seen.z));
  if (!met) return "proxy: none is met";
  const Entity entity = set.proxies[met->index].entity;
  const std::string_view name = frame.world().resource<SceneNames>().name_of(entity);
  return "proxy: " + (name.empty() ? "entity " + std::to_string(entity.index) : std::string(name)) +
         formatted(", met after %.2f m", met->distance_m);
}

}  // namespace

Status add_reflection_pick_copies(FrameBuilder& frame, Captures& copies) {
  const ReflectionHandles* drawn = frame.find<ReflectionHandles>();
  if (drawn == nullptr || !drawn->light.color) return {};
  if (drawn->hits.color) GLOAM_TRY(copies.add(frame.graph(), kScreenCopy, drawn->hits.color));
  GLOAM_TRY(copies.add(frame.graph(), kColorCopy, drawn->light.color));
  return copies.add(frame.graph(), kSurfaceCopy, drawn->light.surface);
}

std::vector<std::string> reflection_pick_lines(const FrameBuilder& frame, const PickedPixel& pixel,
                                               const Captures& copies) {
  const ReflectionPlan* plan = frame.find<ReflectionPlan>();
  const ReflectionHandles* drawn = frame.find<ReflectionHandles>();
  if (plan == nullptr || drawn == nullptr || !(pixel.depth > 0.0f)) return {};
  const auto* probes = frame.find<SurroundingProbes>();
  const char* beyond = probes == nullptr || probes->rows.empty() ? "the sky" : "probes";
  if (!plan->mirror) return {std::string("reflection: ") + beyond};
  const shaders::ReflectionConstants& c = plan->constants;
  const uvec2 texel = glm::min(uvec2(pixel.x, pixel.y) / c.scale, c.size - 1u);
  const std::size_t at = std::size_t{texel.y} * c.size.x + texel.x;
  const auto surface = copies.item<std::uint32_t>(kSurfaceCopy, at);
  if ((surface >> 8 & 0xFFu) == 0) return {std::string("reflection: ") + beyond + " (rough, tilted or not reflective)"};
  const double hundredths = static_cast<double>((surface >> 16 & 0xFFu) + 256 * (surface >> 24));
  const double distance_m = 0.01 * hundredths * static_cast<double>(c.unit_m);
  if (plan->planar)
    return {
        formatted("reflection: mirrored at the height %.3f m, hit after %.2f m", plan->planar->height_m, distance_m)};
  const float screen = drawn->hits.color ? alpha_of(copies, kScreenCopy, at) : 0.0f;
  const float covered = alpha_of(copies, kColorCopy, at);
  const float proxies = std::max(covered - screen, 0.0f);
  const char* tier = screen >= proxies && screen >= 1.0f - covered ? "screen space"
                     : proxies >= 1.0f - covered                   ? "proxies"
                                                                   : beyond;
  std::string text =
      formatted("reflection: %s, confidence of screen space %.2f, of screen space and proxies %.2f, hit after %.2f m",
                tier, static_cast<double>(screen), static_cast<double>(covered), distance_m);
  return {text, proxy_line(frame, *plan, pixel)};
}

}  // namespace gloam

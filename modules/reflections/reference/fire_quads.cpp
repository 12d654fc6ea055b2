// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/reference/fire_quads.h"

#include <algorithm>
#include <utility>

#include "engine/math/packing.h"
#include "engine/scene/components.h"
#include "modules/reflections/captures.h"
#include "modules/reflections/components.h"

namespace gloam {
namespace {

/// In cd/m². light_scale: of the captures.
std::vector<vec4> full_image(const CapturedLayers& layers, std::uint32_t layer, float light_scale) {
  std::vector<vec4> image(std::size_t{layers.side} * layers.side);
  const std::uint16_t* halves = &layers.texels[layer * layers.layer_halves()];
  for (vec4& texel : image)
    for (int c = 0; c < 4; ++c) texel[c] = half_to_float(*halves++) / (c == 3 ? 1.0f : light_scale);
  return image;
}

}  // namespace

FireQuads gather_fire_quads(const World& world, const std::function<float(std::uint32_t layer)>& dim) {
  FireQuads fires;
  const ReflectionCaptures* captures = world.try_resource<ReflectionCaptures>();
  if (captures == nullptr || captures->content == 0) return fires;
  for (std::uint32_t layer = 0; layer < captures->proxy_entities.size(); ++layer) {
    const Entity entity = captures->proxy_entities[layer];
    const IbrProxy* proxy = world.try_get<IbrProxy>(entity);
    const WorldTransform* place = world.try_get<WorldTransform>(entity);
    if (proxy == nullptr || place == nullptr || proxy->kind != IbrProxyKind::fire) continue;
    const float radiance = dim ? dim(layer) : 1.0f;
    if (!(radiance > 0.0f)) continue;
    fires.images.push_back(full_image(captures->proxies, layer, captures->light_scale));
    fires.quads.push_back({.center = dvec3(place->matrix[3]),
                           .half_u = 0.5 * static_cast<double>(proxy->size_m.x) * dvec3(place->matrix[0]),
                           .half_v = 0.5 * static_cast<double>(proxy->size_m.y) * dvec3(place->matrix[1]),
                           .width = captures->proxies.side,
                           .height = captures->proxies.side,
                           .rgba = fires.images.back(),
                           .radiance = radiance,
                           .opacity = std::min(radiance, 1.0f)});
  }
  return fires;
}

}  // namespace gloam

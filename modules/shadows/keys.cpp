// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/keys.h"

#include <algorithm>
#include <span>
#include <string>

#include "engine/ecs/view.h"
#include "engine/render/views/seen_surfaces.h"
#include "engine/scene/components.h"
#include "engine/scene/keys/table.h"
#include "modules/lights/outputs.h"
#include "modules/shadows/atlas/view_faces.h"
#include "modules/shadows/components.h"
#include "modules/shadows/filter/cookies.h"
#include "modules/shadows/knobs.h"
#include "modules/shadows/views/resolution.h"

namespace gloam {
namespace {

struct LightCounts {
  std::size_t casting = 0;
  std::size_t cookies = 0;
};

LightCounts count_lights(const World& world) {
  LightCounts counts;
  world.view<const Light, Maybe<const ShadowCaster>>().each([&](const Light& light, const ShadowCaster* caster) {
    counts.casting += caster == nullptr || caster->enabled ? 1 : 0;
    counts.cookies += has_cookie(light) ? 1 : 0;
  });
  return counts;
}

bool shows_cookie(const World& world, ViewId view) {
  const VisibleLights* visible = world.try_view_resource<VisibleLights>(view);
  if (visible == nullptr) return false;
  const std::span<const Entity> lights = local_lights(*visible);
  return std::any_of(lights.begin(), lights.end(), [&](Entity entity) {
    const Light* light = world.try_get<Light>(entity);
    return light != nullptr && has_cookie(*light);
  });
}

std::string words_of(const LightCounts& counts) {
  if (counts.casting > 0)
    return std::to_string(counts.casting) + (counts.casting == 1 ? " light casts shadows" : " lights cast shadows");
  return std::to_string(counts.cookies) + (counts.cookies == 1 ? " light projects an image" : " lights project images");
}

}  // namespace

void add_shadow_keys(KeyRegistry& registry) {
  registry.add(boolean_key(
      key_line("shadows", KeyElement::light_node, "gloam.light.shadow", "true", "", "whether the light casts shadows"),
      &ShadowCaster::enabled));
  registry.add(integer_key(
      key_line(
          "shadows", KeyElement::light_node, "gloam.light.shadow_resolution", "0", "texels",
          "side of each shadow map face, rounded up to a power of two, at least 16; 0: chosen from screen coverage"),
      0, kMostFace, &ShadowCaster::resolution));
  registry.add(boolean_key(key_line("shadows", KeyElement::mesh_node, "gloam.shadow.cast", "true", "",
                                    "whether the mesh casts shadows; an emissive mesh never casts into the maps of a "
                                    "lamp that it belongs to"),
                           &MeshInstance::casts_shadows));
  registry.add_finish("shadows", &load_cookies);
}

Demand shadow_demand(const World& world, const RenderView* view) {
  const LightCounts counts = count_lights(world);
  if (counts.casting + counts.cookies == 0) return {false, "no light casts shadows"};
  const std::string words = words_of(counts);
  if (view != nullptr && !sees_surfaces(world, *view)) return {false, words + ", only sky in view"};
  if (view == nullptr || (counts.cookies > 0 && shows_cookie(world, view->id))) return {true, words};
  const ShadowSettings* settings = world.try_view_resource<ShadowSettings>(view->id);
  if (settings != nullptr && !settings->enabled) return {false, words + ", but shadows.mode=off"};
  const ViewFaces* view_faces = world.try_view_resource<ViewFaces>(view->id);
  if (view_faces != nullptr && view_faces->casting_lights == 0) return {false, words + ", none in view"};
  return {true, words};
}

}  // namespace gloam

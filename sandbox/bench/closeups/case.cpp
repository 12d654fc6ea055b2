// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/bench/closeups/case.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "engine/ecs/view.h"
#include "modules/accuracy/module.h"
#include "modules/lights/components.h"
#include "modules/shadows/atlas/view_faces.h"
#include "modules/shadows/components.h"
#include "modules/shadows/knobs.h"
#include "modules/shadows/reference/visibility_tracing.h"
#include "sandbox/scenes/lamps/closeups.h"

namespace gloam {
namespace {

constexpr const char* kLargestAtlas = "8192";
constexpr double kMostDensity = 8.0;  // largest shadows.texels_per_pixel that is tried
constexpr double kLeastDensity = 0.25;
constexpr double kCaseStep =
    1.0905077326652577;  // 2^⅛: faces have power-of-two sides and change size at different steps
constexpr double kNearEnough = 1.05;

ViewId view_of(const Session& session) { return session.view_settings(1, 1, "none").id; }

/// Face sizes have hysteresis: starts at the least density, so that each density always gives the same sizes.
Status set_side(ShadowCase& shadows, double density, const char* pairs) {
  GLOAM_TRY(shadows.set("closeups.max_pairs", pairs));
  for (const double each : {kLeastDensity, density}) {
    GLOAM_TRY(shadows.set("shadows.texels_per_pixel", std::to_string(each)));
    if (auto frame = shadows.draw(); !frame) return frame.error();
  }
  return {};
}

/// Counts the texels with this density and at most this many pairs.
Result<MapTexels> texels_at(ShadowCase& shadows, double density, const char* pairs) {
  GLOAM_TRY(set_side(shadows, density, pairs));
  return map_texels(shadows.session());
}

/// Raises the density of standard maps alone until they have at least as many texels as both kinds together. None if
/// kMostDensity is not enough.
Result<std::optional<EqualTexels>> raise_standard(ShadowCase& shadows, EqualTexels texels) {
  texels.standard = 0;
  for (double density = texels.with_density; density <= kMostDensity; density *= kCaseStep) {
    const auto at = texels_at(shadows, density, "0");
    if (!at) return at.error();
    texels.standard_density = density;
    texels.standard = at->standard;
    if (texels.standard >= texels.with) return std::optional(texels);
  }
  return std::optional<EqualTexels>();
}

/// Lowers the density of the standard maps beside close-ups until both kinds together have at most as many texels as
/// standard maps alone. None if kLeastDensity is not low enough.
Result<std::optional<EqualTexels>> lower_beside(ShadowCase& shadows, double user_density, const char* pairs,
                                                std::uint64_t closeups) {
  EqualTexels texels{user_density, user_density, 0, 0};
  const auto alone = texels_at(shadows, user_density, "0");
  if (!alone) return alone.error();
  texels.standard = alone->standard;
  if (closeups >= texels.standard) return std::optional<EqualTexels>();
  for (double density = user_density; density >= kLeastDensity; density /= kCaseStep) {
    const auto at = texels_at(shadows, density, pairs);
    if (!at) return at.error();
    texels.with_density = density;
    texels.with = at->standard + closeups;
    if (texels.with <= texels.standard) return std::optional(texels);
  }
  return std::optional<EqualTexels>();
}

double excess(const EqualTexels& texels) {
  return static_cast<double>(texels.standard) / std::max(1.0, static_cast<double>(texels.with));
}

}  // namespace

Result<CloseupSession> open_closeups(BenchContext& context, int figures) {
  CloseupSession opened;
  if (!context.options().scene_is_default) {
    auto session = context.session();
    if (!session) return session.error();
    opened.session = *session;
    return opened;
  }
  auto session = context.open_builtin(kCloseupScene);
  if (!session) return session.error();
  opened.own = std::move(session).value();
  opened.session = opened.own.get();
  keep_closeup_figures(opened.own->world, figures);
  return opened;
}

OnlyCasting::OnlyCasting(World& world, std::span<const Entity> lights) : world_(world) {
  std::vector<Entity> others;
  world.view<const Light>().each([&](Entity entity, const Light&) {
    if (std::ranges::find(lights, entity) == lights.end()) others.push_back(entity);
  });
  for (const Entity light : others) {
    if (!world.has<ShadowCaster>(light)) {
      world.add(light, ShadowCaster{.enabled = false});
      added_.push_back(light);
    } else if (world.get<ShadowCaster>(light).enabled) {
      world.get<ShadowCaster>(light).enabled = false;
      disabled_.push_back(light);
    }
  }
}

OnlyCasting::~OnlyCasting() {
  for (const Entity light : added_) world_.remove<ShadowCaster>(light);
  for (const Entity light : disabled_) world_.get<ShadowCaster>(light).enabled = true;
}

WithoutMeshes::WithoutMeshes(World& world, std::span<const Entity> casters) : world_(world) {
  for (const Entity caster : casters) {
    taken_.emplace_back(caster, world.get<MeshInstance>(caster));
    world.remove<MeshInstance>(caster);
  }
}

WithoutMeshes::~WithoutMeshes() {
  for (const auto& [caster, mesh] : taken_) world_.add(caster, mesh);
}

Result<TracedVisibility> trace_lights(Session& session, const GeometryPicture& geometry, std::span<const Entity> lights,
                                      std::uint32_t samples) {
  const OnlyCasting only(session.world, lights);
  auto tracer = make_scene_tracer(session.world, *session.executor, geometry.view.position);
  if (!tracer) return tracer.error();
  return trace_visibility({.world = session.world,
                           .geometry = geometry,
                           .tracer = **tracer,
                           .executor = *session.executor,
                           .samples = samples,
                           .progress = {}});
}

std::vector<std::uint8_t> pixels_that_face(const World& world, const GeometryPicture& geometry, Entity light) {
  const dmat4& placed = world.get<WorldTransform>(light).matrix;
  const bool directional = world.get<Light>(light).kind == LightKind::directional;
  std::vector<std::uint8_t> facing(geometry.depth.size(), 0);
  for (std::uint32_t y = 0; y < geometry.view.height; ++y) {
    for (std::uint32_t x = 0; x < geometry.view.width; ++x) {
      const std::size_t pixel = std::size_t{y} * geometry.view.width + x;
      if (geometry.is_sky(pixel)) continue;
      const GeometryTexel texel = geometry.texel(pixel);
      const dvec3 to_light =
          directional ? dvec3(placed[2]) : dvec3(placed[3]) - geometry.view.position - geometry.position(x, y);
      facing[pixel] = texel.subsurface || glm::dot(dvec3(texel.normal), to_light) > 0.0 ? 1 : 0;
    }
  }
  return facing;
}

MapTexels map_texels(const Session& session) {
  const ViewId view = view_of(session);
  MapTexels texels;
  texels.standard = session.world.view_resource<ViewFaces>(view).atlas.used_texels();
  for (const CloseupView& pair : session.world.view_resource<CloseupViews>(view).pairs)
    texels.closeups += std::uint64_t{pair.face.square.size} * pair.face.square.size;
  return texels;
}

Result<EqualTexels> find_equal_texels(ShadowCase& shadows, const char* most_pairs, std::uint64_t closeup_texels) {
  // Start from the density that fits the user's atlas: the larger atlas below must not give either side more texels by
  // itself.
  GLOAM_TRY(shadows.set("shadows.mode", "deferred"));
  GLOAM_TRY(shadows.set("closeups.max_pairs", most_pairs));
  if (auto frame = shadows.draw(); !frame) return frame.error();
  const Session& session = shadows.session();
  const float kept = session.world.view_resource<ViewFaces>(view_of(session)).texels_per_pixel;
  const double users = session.renderer->knobs().value(kShadowTexelsPerPixel);
  const double density = kept > 0.0f ? std::min(static_cast<double>(kept), users) : users;

  GLOAM_TRY(shadows.set("shadows.atlas", kLargestAtlas));
  const auto with = texels_at(shadows, density, most_pairs);
  if (!with) return with.error();
  const std::uint64_t closeups = closeup_texels > 0 ? closeup_texels : with->closeups;
  if (closeups == 0) return Error{ErrorKind::failed, "the camera shows no close-up"};
  auto raised = raise_standard(shadows, {density, density, with->standard + closeups, 0});
  if (!raised || (*raised && excess(**raised) <= kNearEnough)) {
    if (!raised) return raised.error();
    return **raised;
  }
  auto lowered = lower_beside(shadows, density, most_pairs, closeups);
  if (!lowered) return lowered.error();
  if (!*raised && !*lowered) return Error{ErrorKind::failed, "no atlas holds as many texels as the close-ups have"};
  if (!*raised) return **lowered;
  if (!*lowered) return **raised;
  return excess(**lowered) < excess(**raised) ? **lowered : **raised;
}

Status use_closeups(ShadowCase& shadows, const EqualTexels& texels, const char* most_pairs) {
  return set_side(shadows, texels.with_density, most_pairs);
}

Status use_standard(ShadowCase& shadows, const EqualTexels& texels) {
  return set_side(shadows, texels.standard_density, "0");
}

}  // namespace gloam

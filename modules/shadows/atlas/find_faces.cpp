// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/atlas/find_faces.h"

#include <algorithm>
#include <cmath>

#include "engine/core/assert.h"
#include "modules/shadows/atlas/paced_sizes.h"
#include "modules/shadows/views/faces.h"
#include "modules/shadows/views/resolution.h"

namespace gloam {
namespace {

constexpr std::size_t kGrain = 64;  // lights per job
/// A cube face shows a quarter of the surroundings, and half the diameter of the light's sphere in the picture.
constexpr float kCubeShare = 0.5f;
constexpr std::size_t kMostDirectional = std::size(decltype(shaders::ShadowBlock::directional){});
constexpr float kWidestSun = 3.0f;  // radians of apparent angle; the tangent of half of it is finite

bool earlier(const WantedSize& a, const WantedSize& b) { return a.light.index < b.light.index; }

/// The face size requested for a light in the last frame; 0 if the light was not in view. wanted: ordered by entity
/// index.
std::uint32_t size_before(std::span<const WantedSize> wanted, Entity light) {
  const auto found = std::lower_bound(wanted.begin(), wanted.end(), WantedSize{light, 0}, earlier);
  return found != wanted.end() && found->light == light ? found->size : 0;
}

/// The planned faces of a local light.
struct LocalPlan {
  LocalShadow shadow;
  float pixels = 0.0f;       ///< pixels across a face's content, ≥ 1; 0: its ShadowCaster sets the size
  std::uint32_t before = 0;  ///< face size that it wanted in the last frame
  std::uint32_t size = 0;    ///< face size
  float importance = 0.0f;
  bool fills_view =
      false;  ///< the camera is so near to what the light lights that `pixels` is the picture's longer side
  std::size_t first_request = 0;
  std::size_t first_face = 0;
  bool placed = false;
};

LocalPlan plan_local(const ShadowLight& light, const RenderView& view, const ShadowSettings& settings,
                     std::span<const WantedSize> wanted) {
  LocalPlan plan;
  plan.shadow = local_shadow(light.light, light.world_from_node, settings.kernel_rim, settings.d16);
  if (!settings.enabled || !light.caster.enabled) plan.shadow.kind = GLOAM_SHADOW_NONE;
  if (plan.shadow.kind == GLOAM_SHADOW_NONE) return plan;
  const bool known = light.bounds.radius_m > 0.0f;
  const dvec3 center = known ? light.bounds.center : plan.shadow.position;
  const float radius = known ? light.bounds.radius_m : plan.shadow.range_m;
  plan.importance = coverage(view, center, radius) * brightness_of(light.light);
  if (light.caster.resolution > 0) {
    plan.size = asked_size(light.caster.resolution);
    return plan;
  }
  // Texels are spread across the light's direction: the length of a narrow cone does not matter.
  const bool cube = plan.shadow.kind == GLOAM_SHADOW_CUBE;
  const float share = cube ? kCubeShare : std::min(1.0f, plan.shadow.range_m * plan.shadow.tan_inner / radius);
  const float across = pixels_across(view, center, radius);
  plan.fills_view = across >= static_cast<float>(std::max(view.width, view.height));
  plan.pixels = std::max(1.0f, across * share);
  plan.before = size_before(wanted, light.entity);
  return plan;
}

std::uint32_t size_at(const LocalPlan& plan, float density) {
  return plan.pixels > 0.0f ? wanted_size(plan.pixels * density, plan.before) : plan.size;
}

/// The plan for a directional light's cascades.
struct DirectionalPlan {
  FaceAxes axes;
  std::size_t first_request = 0;
  std::size_t count = 0;   ///< number of requests
  std::uint32_t size = 0;  ///< texels of each cascade's side
};

/// Size of each cascade of a light whose ShadowCaster sets none. The cascades of one light fill at most a quarter of
/// the atlas, those of all lights at most half of it.
/// sharers: views that share the atlas. Each plans for its part, so that all find room.
std::uint32_t cascade_size(std::size_t lights, const RenderView& view, const ShadowSettings& settings,
                           std::uint32_t sharers) {
  const float pixels = static_cast<float>(std::max(view.width, view.height));
  std::uint32_t most = settings.atlas_size / 4;
  const auto side = static_cast<std::size_t>(settings.atlas_size);
  while (most > 0 && lights * GLOAM_MAX_CASCADES * most * most > side * side / 2 / sharers) most /= 2;
  return std::max<std::uint32_t>(GLOAM_SHADOW_SMALLEST_FACE,
                                 std::min(wanted_size(pixels * settings.texels_per_pixel, 0), most));
}

struct Plans {
  std::vector<LocalPlan> local;
  std::vector<DirectionalPlan> directional;
  std::vector<CascadeSphere> spheres;  ///< the same for all directional lights
  std::vector<FaceRequest> requests;
};

void plan_directional(std::span<const ShadowLight> lights, const RenderView& view, const ShadowSettings& settings,
                      const CasterBounds& casters, std::uint32_t sharers, Plans& plans) {
  plans.directional.resize(std::min(lights.size(), kMostDirectional));
  if (lights.empty() || !settings.enabled) return;
  plans.spheres = cascade_spheres(view, casters, std::min<std::uint32_t>(settings.cascades, GLOAM_MAX_CASCADES));
  const std::uint32_t size = cascade_size(plans.directional.size(), view, settings, sharers);
  for (std::size_t i = 0; i < plans.directional.size(); ++i) {
    const std::uint32_t asked = lights[i].caster.resolution;
    plans.directional[i].count = lights[i].caster.enabled ? plans.spheres.size() : 0;
    plans.directional[i].size = asked > 0 ? asked_size(asked) : size;
  }
}

double texels_of(std::size_t faces, std::uint32_t size) {
  return static_cast<double>(faces) * static_cast<double>(size) * static_cast<double>(size);
}

/// The density for local lights' maps, in the part of the atlas that cascades leave.
float local_density(const ShadowSettings& settings, const Plans& plans, std::uint32_t sharers, float previous) {
  double room = texels_of(1, settings.atlas_size) / sharers;
  for (const DirectionalPlan& plan : plans.directional) room -= texels_of(plan.count, plan.size);
  return fitting_density(settings.texels_per_pixel, previous, room, [&](float density) {
    double texels = 0.0;
    for (const LocalPlan& plan : plans.local) texels += texels_of(plan.shadow.face_count(), size_at(plan, density));
    return texels;
  });
}

/// FaceKey::view of cascades.
std::uint32_t view_of_cascades(const RenderView& view, const ViewFaces& shadows) {
  return shadows.shared == nullptr ? 0 : view.id.value + 1;
}

void request_directional(std::span<const ShadowLight> lights, const RenderView& view, ViewFaces& shadows,
                         Plans& plans) {
  for (std::size_t i = 0; i < plans.directional.size(); ++i) {
    DirectionalPlan& plan = plans.directional[i];
    plan.first_request = plans.requests.size();
    if (plan.size == 0 || !lights[i].caster.enabled) {
      plan.count = 0;
      continue;
    }
    plan.axes = node_axes(lights[i].world_from_node);
    ++shadows.casting_lights;
    // Outer cascades show less of the picture.
    for (const CascadeSphere& sphere : plans.spheres)
      plans.requests.push_back({{lights[i].entity, sphere.slice, view_of_cascades(view, shadows)},
                                plan.size,
                                brightness_of(lights[i].light) / static_cast<float>(sphere.slice + 1)});
  }
}

/// Sets the sizes of local lights' faces, and stores them for the next frame.
void size_local(std::span<const ShadowLight> lights, ViewFaces& shadows, Plans& plans) {
  shadows.wanted.clear();
  for (std::size_t i = 0; i < lights.size(); ++i) {
    LocalPlan& plan = plans.local[i];
    plan.size = size_at(plan, shadows.texels_per_pixel);
    if (plan.size == 0) continue;
    ++shadows.casting_lights;
    if (lights[i].caster.resolution == 0) shadows.wanted.push_back({lights[i].entity, plan.size});
  }
  std::sort(shadows.wanted.begin(), shadows.wanted.end(), earlier);
}

/// Under a time budget, lets only some lights change the sizes of their faces in this frame.
void pace(std::span<const ShadowLight> local, std::span<const ShadowLight> directional, const RenderView& view,
          const ShadowSettings& settings, ViewFaces& shadows, Plans& plans) {
  std::vector<PacedLight> lights;
  const auto add = [&](const FaceKey& first, std::size_t faces, std::uint32_t wanted, float importance) {
    lights.push_back(
        {static_cast<std::uint32_t>(faces), shadows.atlas.square_of(first).size, faces > 0 ? wanted : 0, importance});
  };
  for (std::size_t i = 0; i < plans.local.size(); ++i) {
    const LocalPlan& plan = plans.local[i];
    add({local[i].entity, 0}, plan.shadow.face_count(), plan.size, plan.importance);
  }
  for (std::size_t i = 0; i < plans.directional.size(); ++i) {
    const DirectionalPlan& plan = plans.directional[i];
    const std::uint32_t slice = plans.spheres.empty() ? 0 : plans.spheres.front().slice;
    add({directional[i].entity, slice, view_of_cascades(view, shadows)}, plan.count, plan.size,
        brightness_of(directional[i].light));
  }
  const std::uint64_t room = std::uint64_t{settings.atlas_size} * settings.atlas_size;
  shadows.faces_waiting = pace_sizes(lights, room, shadows.filling);
  for (std::size_t i = 0; i < plans.local.size(); ++i) plans.local[i].size = lights[i].size;
  for (std::size_t i = 0; i < plans.directional.size(); ++i)
    plans.directional[i].size = lights[plans.local.size() + i].size;
}

void request_local(std::span<const ShadowLight> lights, Plans& plans) {
  for (std::size_t i = 0; i < lights.size(); ++i) {
    LocalPlan& plan = plans.local[i];
    plan.first_request = plans.requests.size();
    if (plan.size == 0) continue;
    for (std::uint32_t f = 0; f < plan.shadow.face_count(); ++f)
      plans.requests.push_back({{lights[i].entity, f}, plan.size, plan.importance});
  }
}

/// Faces with fewer texels than shadows.texels_per_pixel asks for: surfaces may be nearer than the plan assumes, or the
/// density was lowered so that all maps fit.
std::uint32_t count_at_limit(const Plans& plans, const ShadowSettings& settings, float density) {
  std::uint32_t count = 0;
  for (const LocalPlan& plan : plans.local)
    if (plan.placed && plan.pixels > 0.0f && (plan.fills_view || density < 0.99f * settings.texels_per_pixel))
      count += static_cast<std::uint32_t>(plan.shadow.face_count());
  return count;
}

/// Fills the faces and rows of local lights, in parallel over lights.
void fill_local(std::span<const ShadowLight> lights, const FacePlaces& places, const ShadowSettings& settings,
                JobExecutor& jobs, Plans& plans, ViewFaces& shadows) {
  std::size_t faces = 0;
  for (LocalPlan& plan : plans.local) {
    plan.first_face = faces;
    plan.placed = plan.size > 0 && plan.shadow.face_count() > 0 && places.squares[plan.first_request].size > 0;
    if (plan.placed) faces += plan.shadow.face_count();
  }
  shadows.faces.resize(faces);
  shadows.rows.resize(lights.size());
  jobs.parallel_for(lights.size(), kGrain, [&](JobRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      LocalPlan& plan = plans.local[i];
      const std::size_t count = plan.placed ? plan.shadow.face_count() : 0;
      const std::span<const AtlasSquare> squares = std::span(places.squares).subspan(plan.first_request, count);
      // Kernels that leave a cube's face continue in other faces, so only spots have a rim.
      if (count > 0 && plan.shadow.kind == GLOAM_SHADOW_SPOT)
        plan.shadow.tan_half = plan.shadow.tan_inner * (1.0f + rim_share(squares[0].size, settings.kernel_rim));
      shadows.rows[i] = shadow_row(plan.shadow, squares);
      for (std::uint32_t f = 0; f < count; ++f) {
        ShadowFace face = local_face(lights[i].entity, plan.shadow, f);
        face.square = squares[f];
        face.importance = plan.importance;
        shadows.faces[plan.first_face + f] = face;
      }
    }
  });
}

void fill_directional(std::span<const ShadowLight> lights, const FacePlaces& places, const RenderView& view,
                      const ShadowSettings& settings, const CasterBounds& casters, const Plans& plans,
                      ViewFaces& shadows) {
  for (std::size_t i = 0; i < kMostDirectional; ++i) {
    shaders::DirectionalShadow& directional = shadows.block.directional[i];
    directional = {};
    directional.traced_layer = -1.0f;
    if (i >= plans.directional.size()) continue;
    const float angle = lights[i].light.apparent_angle;
    directional.penumbra_m_per_m = angle > 0.0f ? 2.0f * std::tan(0.5f * std::min(angle, kWidestSun)) : 0.0f;
    const DirectionalPlan& plan = plans.directional[i];
    for (std::size_t c = 0; c < plan.count; ++c) {
      const std::size_t request = plan.first_request + c;
      const AtlasSquare& square = places.squares[request];
      if (square.size == 0) continue;
      const float rim = rim_share(square.size, settings.kernel_rim);
      ShadowFace face = cascade_face(lights[i].entity, plan.axes, plans.spheres[c], casters, square, rim);
      face.importance = plans.requests[request].importance;
      face.view = plans.requests[request].key.view;
      directional.cascades[directional.cascade_count++] = cascade_constants(face, view.position, rim);
      shadows.faces.push_back(face);
    }
  }
}

/// Sizes of faces keep to those of the frame before while they still fit. After a change of what they were chosen for,
/// or a cut, they are chosen anew: otherwise a picture would depend on settings that are long gone.
void forget_sizes(const RenderView& view, const ShadowSettings& settings, std::uint32_t sharers, ViewFaces& shadows) {
  const bool changed = shadows.settings != settings;
  const bool was_off = shadows.sharers == 0 || view.frame > shadows.frame + 1;
  const bool switched_on = was_off && shadows.knobs_version != shadows.drawn_knobs_version;
  shadows.filling = view.paced && !view.camera_cut() && (switched_on || (shadows.filling && shadows.faces_waiting > 0));
  shadows.frame = view.frame;
  shadows.drawn_knobs_version = shadows.knobs_version;
  shadows.faces_waiting = 0;
  if (changed) shadows.side = {};
  if (changed || shadows.sharers != sharers || view.camera_cut()) {
    shadows.texels_per_pixel = 0.0f;
    shadows.wanted.clear();
  }
  shadows.settings = settings;
  shadows.sharers = sharers;
}

}  // namespace

void find_shadows(std::span<const ShadowLight> local, std::span<const ShadowLight> directional, const RenderView& view,
                  const ShadowSettings& settings, const CasterBounds& casters, JobExecutor& jobs, ViewFaces& shadows) {
  const std::uint32_t sharers = shadows.shared == nullptr ? 1 : shadows.shared->sharers();
  forget_sizes(view, settings, sharers, shadows);
  Plans plans;
  plans.local.resize(local.size());
  shadows.casting_lights = 0;
  jobs.parallel_for(local.size(), kGrain, [&](JobRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i)
      plans.local[i] = plan_local(local[i], view, settings, shadows.wanted);
  });
  plan_directional(directional, view, settings, casters, sharers, plans);
  shadows.texels_per_pixel = local_density(settings, plans, sharers, shadows.texels_per_pixel);
  size_local(local, shadows, plans);
  const bool own_places = shadows.shared == nullptr || shadows.leads;
  if (view.paced && own_places && !view.camera_cut()) pace(local, directional, view, settings, shadows, plans);
  request_local(local, plans);
  request_directional(directional, view, shadows, plans);
  // Companions need little more room: mostly for cascades.
  const bool spare = shadows.spare_for_overlays || shadows.leads;
  // An atlas of another side is another image, without the maps. So that no change of knobs needs one, it is the
  // largest from the start.
  const std::uint32_t side =
      view.paced ? settings.atlas_size : shadows.side.next(plans.requests, spare, settings.atlas_size);
  if (shadows.leads) shadows.shared->set_side(side);
  const bool has_side = shadows.shared != nullptr && shadows.shared->side() > 0;
  const std::uint32_t shared_side = has_side ? shadows.shared->side() : settings.atlas_size;
  const FacePlaces places = shadows.shared == nullptr ? shadows.atlas.place(side, plans.requests)
                                                      : shadows.shared->place(view.frame, shared_side, plans.requests);
  if (shadows.shared != nullptr) shadows.atlas = shadows.shared->atlas();
  shadows.faces_shrunk = places.shrunk;
  shadows.faces_left_out = places.left_out;
  fill_local(local, places, settings, jobs, plans, shadows);
  shadows.faces_at_limit = count_at_limit(plans, settings, shadows.texels_per_pixel);
  fill_directional(directional, places, view, settings, casters, plans, shadows);
}

}  // namespace gloam

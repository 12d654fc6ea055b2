// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/planar/mirror.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "engine/math/bounds.h"
#include "engine/math/frustum.h"
#include "modules/reflections/override.h"
#include "modules/reflections/scene_unit.h"

namespace gloam {
namespace {

// In scene_unit()s.
constexpr double kNear = 20.0;           // patches farther away count less, by the square of their distance
constexpr double kLeastHeight = 1e-3;    // of a camera above a plane that it sees
constexpr double kClipMargin = 1e-3;     // above the highest point of the mirroring surface
constexpr double kSurfaceSlack = 0.005;  // of positions from the depth image

/// The patch's area as the view weighs it; 0: the camera does not see it from above.
double weight_in(const RenderView& view, const MirrorPatch& patch, double unit) {
  const bool above = view.camera.orthographic ? view.view_from_relative[1][2] > 1e-4f
                                              : view.position.y > patch.height_m + kLeastHeight * unit;
  if (!above) return 0.0;
  Aabb box;
  box.grow(view.relative(patch.min));
  box.grow(view.relative(patch.max));
  if (!may_intersect(view.frustum, box)) return 0.0;
  const double away = glm::length(glm::clamp(view.position, patch.min, patch.max) - view.position);
  const double falloff = std::min(1.0, kNear * unit / std::max(away, kNear * unit));
  return patch.mirrors_m2 * falloff * falloff;
}

/// Whether frames show no tier of reflections, because a reference takes their place.
bool is_replaced(const World& world) {
  const auto* traced = world.try_resource<TracedReflections>();
  const auto* change = world.try_resource<ReflectionOverride>();
  return traced != nullptr || (change != nullptr && *change == ReflectionOverride::no_specular);
}

}  // namespace

std::optional<PlanarMirror> choose_mirror(std::span<const MirrorPatch> patches, const RenderView& view, double unit) {
  struct Seen {
    const MirrorPatch* patch;
    double weight;
  };
  std::vector<Seen> seen;
  for (const MirrorPatch& patch : patches)
    if (const double weight = weight_in(view, patch, unit); weight > 0.0) seen.push_back({&patch, weight});
  std::ranges::sort(seen, {}, [](const Seen& s) { return s.patch->min.y; });
  double best = 0.0;
  PlanarMirror mirror;
  for (std::size_t first = 0; first < seen.size(); ++first) {
    const double low = seen[first].patch->min.y, limit = low + kPlaneThickness * unit;
    double sum = 0.0, moment = 0.0, high = low;
    for (std::size_t i = first; i < seen.size() && seen[i].patch->min.y <= limit; ++i) {
      if (seen[i].patch->max.y > limit) continue;
      sum += seen[i].weight;
      moment += seen[i].weight * (seen[i].patch->height_m - low);
      high = std::max(high, seen[i].patch->max.y);
    }
    if (!(sum > best)) continue;
    best = sum;
    mirror.height_m = low + moment / sum;
    mirror.slack_m = std::max(high - mirror.height_m, mirror.height_m - low) + kSurfaceSlack * unit;
  }
  return best > 0.0 ? std::optional(mirror) : std::nullopt;
}

ViewSettings mirrored_settings(const ViewSettings& main, const PlanarMirror& mirror, std::uint32_t scale, double unit) {
  ViewSettings settings = main;
  // The same part of the world for odd sizes, too.
  if (!main.exact_width && main.aspect <= 0.0f)
    settings.aspect = static_cast<float>(main.width) / static_cast<float>(main.height);
  settings.width = (main.width + scale - 1) / scale;
  settings.height = (main.height + scale - 1) / scale;
  settings.purpose = ViewPurpose::capture;
  settings.visualizer = "none";
  settings.mirror =
      MirrorPlane{.offset = mirror.height_m, .margin_m = mirror.slack_m + (kClipMargin - kSurfaceSlack) * unit};
  return settings;
}

void add_mirrored_view(World& world, const ViewSettings& main, const ReflectionKnobs& knobs,
                       CompanionViews& companions) {
  std::optional<PlanarMirror>& kept = world.try_view_resource<std::optional<PlanarMirror>>(main.id) != nullptr
                                          ? world.view_resource<std::optional<PlanarMirror>>(main.id)
                                          : world.set_view_resource(main.id, std::optional<PlanarMirror>());
  kept.reset();
  if (knobs.mode != ReflectionKnobs::Mode::planar || is_replaced(world) || main.mirror) return;
  auto& patches = world.resource<MirrorPatches>();
  patches.update(world);
  const double unit = scene_unit(world);
  kept = choose_mirror(patches.all(), make_view(main, 0), unit);
  if (kept) kept->view = companions.add(mirrored_settings(main, *kept, knobs.scale(), unit));
}

}  // namespace gloam

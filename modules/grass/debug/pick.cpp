// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/grass/debug/pick.h"

#include <algorithm>
#include <array>
#include <glm/ext/quaternion_common.hpp>
#include <limits>

#include "engine/core/text/formatted.h"
#include "engine/render/readback/geometry_picture.h"
#include "engine/scene/units.h"
#include "modules/grass/reference/slave_pose.h"

namespace gloam {
namespace {

constexpr const char* kBlades = "grass.blades";
constexpr const char* kDraws = "grass.draws";
constexpr const char* kKnotCopy = "grass.knots";
constexpr const char* kPreviousCopy = "grass.previous_knots";

double distance_to_segment(const dvec3& point, const dvec3& from, const dvec3& to) {
  const dvec3 along = to - from;
  const double t = glm::dot(point - from, along) / std::max(glm::dot(along, along), 1e-18);
  return glm::length(point - from - std::clamp(t, 0.0, 1.0) * along);
}

struct NearestBlade {
  double distance_m = std::numeric_limits<double>::infinity();  ///< from the point to the stem
  std::uint32_t slot = 0;                                       ///< in the field
};

/// Finds the live blade whose stem is nearest to a point.
class BladeSearch {
 public:
  BladeSearch(const FrameBuilder& frame, const GrassFrame& grass, const Captures& copies, const dvec3& point)
      : field_(frame.world().resource<GrassField>()), grass_(grass), copies_(copies), point_(point) {}

  [[nodiscard]] NearestBlade nearest() const {
    NearestBlade best;
    const auto live = copies_.item<shaders::GrassDraws>(kDraws, 0).live;
    for (std::uint32_t i = 0; i < live; ++i) {
      const auto sorted = copies_.item<std::uint32_t>(kBlades, i);
      const ResidentPatch& resident = grass_.stored.patches[sorted / GLOAM_GRASS_PATCH_BLADES];
      const std::uint32_t index = sorted % GLOAM_GRASS_PATCH_BLADES;
      const GrassPatch& patch = field_.patches[resident.patch];
      const GrassBlade& blade = field_.blades[resident.patch * GLOAM_GRASS_PATCH_BLADES + index];
      const dvec3 at = glm::conjugate(patch.turn) * (point_ - patch.origin) - dvec3(blade.root_m);
      if (glm::length(at) > 1.1 * static_cast<double>(blade.length_m)) continue;
      const double distance_m = distance_to_stem(at, resident, blade, index);
      if (distance_m < best.distance_m) best = {distance_m, blade.slot};
    }
    return best;
  }

 private:
  [[nodiscard]] dvec3 knot(const char* copy, std::uint32_t place, std::uint32_t k) const {
    return dvec3(copies_.item<vec4>(copy, std::size_t{place} * GLOAM_GRASS_KNOTS + k));
  }
  /// at: relative to the blade's root.
  [[nodiscard]] double distance_to_stem(const dvec3& at, const ResidentPatch& resident, const GrassBlade& blade,
                                        std::uint32_t index) const {
    const GrassBlade& master = field_.blades[blade.master];
    const std::uint32_t place = resident.slot * grass_.stored.slot_masters + blade.master % GLOAM_GRASS_PATCH_BLADES;
    const dvec3 master_root(master.root_m);
    constexpr std::uint32_t kTip = GLOAM_GRASS_KNOTS - 1;
    const dvec3 tip = knot(kKnotCopy, place, kTip);
    const double tip_speed =
        glm::length(tip - knot(kPreviousCopy, place, kTip)) / static_cast<double>(grass_.steps.step_s);
    SlaveTurn turn{{dvec3(1, 0, 0), dvec3(0, 1, 0), dvec3(0, 0, 1)}};
    if (blade.slot != master.slot)
      turn = slave_turn(stem_of(master), stem_of(blade), index, tip - master_root,
                        blade_model(master, field_.types).rest[kTip], tip_speed);
    double best = std::numeric_limits<double>::infinity();
    dvec3 below(0.0);
    for (std::uint32_t k = 1; k <= kTip; ++k) {
      const dvec3 above = slave_knot(turn, knot(kKnotCopy, place, k) - master_root);
      best = std::min(best, distance_to_segment(at, below, above));
      below = above;
    }
    return best;
  }
  static SlaveStem stem_of(const GrassBlade& blade) {
    return {dvec3(blade.ground_normal), static_cast<double>(blade.yaw), static_cast<double>(blade.length_m)};
  }

  const GrassField& field_;
  const GrassFrame& grass_;
  const Captures& copies_;
  dvec3 point_;
};

}  // namespace

Status add_grass_pick_copies(FrameBuilder& frame, const GrassFrame& grass, Captures& copies) {
  GLOAM_TRY(copies.add(frame.graph(), kBlades, grass.sorted.blades));
  GLOAM_TRY(copies.add(frame.graph(), kDraws, grass.sorted.draws));
  GLOAM_TRY(copies.add(frame.graph(), kKnotCopy, grass.stored.store.knots));
  return copies.add(frame.graph(), kPreviousCopy, grass.stored.store.previous_knots);
}

std::vector<std::string> grass_pick_lines(const FrameBuilder& frame, const GrassFrame& grass, const PickedPixel& pixel,
                                          const Captures& copies) {
  if (!(pixel.depth > 0.0f)) return {};
  const RenderView& view = frame.view();
  const double metres = metres_per_unit(frame.world());
  const dvec3 point = (view.position + surface_position(view, pixel.x, pixel.y, pixel.depth)) * metres;
  const NearestBlade found = BladeSearch(frame, grass, copies, point).nearest();
  // Blades are widened to about a pixel, so the point may be half a widened blade away from the stem.
  const double pixel_m = static_cast<double>(grass.lod.pixel_m) *
                         (grass.lod.orthographic != 0 ? 1.0 : glm::length(point - view.position * metres));
  if (!(found.distance_m < 0.01 + pixel_m)) return {};
  const GrassField& field = frame.world().resource<GrassField>();
  const GrassBlade& blade = field.blades[found.slot];
  const std::string text =
      formatted("grass: blade %u (patch %u), length %.3f m, width %.4f m, type %u, rank %.2f", blade.slot,
                blade.slot / GLOAM_GRASS_PATCH_BLADES, static_cast<double>(blade.length_m),
                static_cast<double>(blade.width_m), static_cast<unsigned>(blade.type), static_cast<double>(blade.rank));
  std::string master = "grass: a master, simulated itself";
  if (blade.master != blade.slot)
    master = "grass: copies master " + std::to_string(blade.master) + " of the same patch";
  return {text, master};
}

}  // namespace gloam

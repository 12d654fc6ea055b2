// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/closeups/compose/frame.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "modules/closeups/umbra/umbra_projection.h"
#include "modules/lights/outputs.h"

namespace gloam {
namespace {

bool add_copies(const FrameBuilder& frame, const CloseupView& pair, OverlayPlan& overlay) {
  const auto& subject = frame.world().resource<CloseupSubjects>().subjects[pair.subject_index];
  return overlay.add(pair.light, subject.low, subject.high);
}

OverlayPlan empty_plan(const FrameBuilder& frame) { return OverlayPlan(frame.world(), frame.view().id); }

/// Surfaces that are shaded from standard maps in every frame.
class ForwardLit {
 public:
  explicit ForwardLit(const FrameBuilder& frame) : view_(frame.view()) {
    for (const Draw& draw : frame.draws().blended) {
      WorldBox box;
      if (!draw.bounds.empty())
        box = {dvec3(draw.bounds.min) + view_.position, dvec3(draw.bounds.max) + view_.position};
      surfaces_.push_back({box, std::nullopt});
    }
  }

  /// Whether one of them may be in the shadow of the pair's subject: it meets the beam behind the near side of the
  /// pair's face, and the tiles of the pair.
  [[nodiscard]] bool may_be_shadowed_by(const CloseupView& pair) {
    ShadowFace beam = pair.face;
    beam.far_m = std::numeric_limits<float>::infinity();
    for (Surface& surface : surfaces_) {
      if (surface.box.known() && !face_may_see(beam, surface.box.min, surface.box.max)) continue;
      if (!surface.tiles) surface.tiles = box_tiles(surface.box, view_);
      if (surface.tiles->overlaps(pair.tiles)) return true;
    }
    return false;
  }

 private:
  struct Surface {
    WorldBox box;
    std::optional<TileRange> tiles;  ///< found when first needed
  };
  const RenderView& view_;
  std::vector<Surface> surfaces_;
};

}  // namespace

std::optional<ReservedTiles> reserve_umbra(const FrameBuilder& frame, std::span<const CloseupView> pairs) {
  const uvec2 size = (uvec2(frame.view().width, frame.view().height) + uvec2(kShadowTile - 1)) / uvec2(kShadowTile);
  std::vector<std::uint32_t> tiles((std::size_t{size.x} * size.y + 31) / 32, 0);
  std::vector<Entity> lights;
  for (const CloseupView& pair : pairs) {
    if (std::ranges::find(lights, pair.light) == lights.end()) lights.push_back(pair.light);
    for (std::uint32_t y = pair.tiles.begin.y; y < pair.tiles.end.y; ++y)
      for (std::uint32_t tile = y * size.x + pair.tiles.begin.x; tile < y * size.x + pair.tiles.end.x; ++tile)
        tiles[tile / 32] |= 1u << (tile % 32);
  }
  return reserve_tiles(frame, std::move(tiles), lights);
}

CloseupFrame plan_closeup_frame(const FrameBuilder& frame, bool reserved) {
  const CloseupViews& views = frame.world().view_resource<CloseupViews>(frame.view().id);
  CloseupFrame closeups;
  closeups.skipped = views.skipped;
  closeups.overlay = empty_plan(frame);
  ForwardLit forward_lit(frame);
  for (const CloseupView& pair : views.pairs) {
    const bool needed = !reserved || forward_lit.may_be_shadowed_by(pair);
    if (needed && !add_copies(frame, pair, closeups.overlay)) {
      ++closeups.skipped;
      continue;
    }
    closeups.pairs.push_back(pair);
    closeups.in_overlay.push_back(needed ? 1 : 0);
  }
  return closeups;
}

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/drawn_faces.h"

#include <bit>
#include <span>
#include <utility>

#include "engine/core/hash.h"
#include "modules/shadows/caster_states.h"

namespace gloam {
namespace {

/// With more, faces are drawn whole: looking at all for every face would cost more than it saves.
constexpr std::size_t kMostChanges = 2048;

/// Whatever maps depend on beside face and casters.
std::uint64_t salt_of(const FrameBuilder& frame, const ShadowKnobs& knobs) {
  return Hasher()
      .value(frame.world().resource<SceneAssets>().version)
      .value(std::bit_cast<std::uint32_t>(knobs.bias_units))
      .value(knobs.mip_operator)
      .value(knobs.simplified)
      .digest();
}

/// What of the face's map is not as it should be.
std::vector<TexelRect> stale_regions(const ViewShadows& kept, const ShadowFace& face, const FaceContent& content) {
  const CasterHistory& history = kept.history;
  if (kept.cache.holds(face, content)) return {};
  if (!kept.cache.held(face, content, history.frame() - 1) || history.changed().size() > kMostChanges)
    return {whole_face(face)};
  return covered_regions(face, history.changed());
}

void find_draws(DrawnFace& face, DrawnRegion& region, std::span<const Caster> casters, bool simplified) {
  if (face.content.casters == 0) return;
  const bool whole = region.texels == whole_face(face.face);
  const FaceVolume volume = whole ? face_volume(face.face) : face_volume(face.face, region.texels);
  region.draws = face_draws(volume, casters, simplified);
  for (const FaceDraw& draw : region.draws)
    region.matrices.push_back(clip_from_mesh(face.face, draw.caster->world_from_mesh));
}

/// Faces with a place, and what their maps are made from.
struct PlacedFaces {
  std::vector<ShadowFace> faces;
  std::vector<FaceContent> contents;
  std::vector<std::vector<TexelRect>> stale;
};

PlacedFaces placed_faces(FrameBuilder& frame, ViewShadows& kept, const ShadowViews& views, const ShadowKnobs& knobs) {
  JobExecutor& executor = frame.services().executor;
  PlacedFaces placed;
  for (const ShadowFace& face : views.faces)
    if (face.square.size > 0) placed.faces.push_back(face);
  std::vector<CasterState> states =
      caster_states(frame.casters().casters, caster_poses(frame.world(), frame.draws()), executor);
  placed.contents = face_contents(placed.faces, states, salt_of(frame, knobs), executor);
  kept.history.advance(std::move(states));
  placed.stale.resize(placed.faces.size());
  executor.parallel_for(placed.faces.size(), 8, [&](JobRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i)
      placed.stale[i] = stale_regions(kept, placed.faces[i], placed.contents[i]);
  });
  return placed;
}

}  // namespace

std::vector<DrawnFace> faces_to_draw(FrameBuilder& frame, ViewShadows& kept, const ShadowViews& views,
                                     const ShadowKnobs& knobs) {
  const PlacedFaces placed = placed_faces(frame, kept, views, knobs);
  std::vector<DrawnFace> drawn;
  kept.counts = {};
  kept.drawn.clear();
  for (std::size_t i = 0; i < placed.faces.size(); ++i) {
    const ShadowFace& face = placed.faces[i];
    const FaceContent& content = placed.contents[i];
    if (placed.stale[i].empty()) {
      kept.cache.keep(face, content, kept.history.frame());
      ++kept.counts.cached;
      continue;
    }
    DrawnFace& added = drawn.emplace_back(DrawnFace{face, content, {}});
    for (const TexelRect& texels : placed.stale[i]) {
      added.regions.push_back({texels, {}, {}});
      kept.counts.texels += texels.texels();
    }
    kept.drawn.push_back({face.light, face.index});
    if (content.casters == 0) ++kept.counts.skipped;
  }
  kept.counts.drawn = static_cast<std::uint32_t>(drawn.size()) - kept.counts.skipped;
  const std::span<const Caster> casters = frame.casters().casters;
  frame.services().executor.parallel_for(drawn.size(), 1, [&](JobRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i)
      for (DrawnRegion& region : drawn[i].regions) find_draws(drawn[i], region, casters, knobs.simplified);
  });
  return drawn;
}

}  // namespace gloam

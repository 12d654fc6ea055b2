// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/atlas/drawn_faces.h"

#include <algorithm>
#include <bit>
#include <span>
#include <utility>

#include "engine/core/hash.h"
#include "modules/shadows/atlas/caster_states.h"

namespace gloam {
namespace {

/// With more changed boxes, faces are drawn whole: testing all boxes for every face would cost more than it saves.
constexpr std::size_t kMostChanges = 2048;

/// Hash of everything that maps depend on besides face and casters.
std::uint64_t salt_of(const FrameBuilder& frame, const ShadowKnobs& knobs) {
  return Hasher()
      .value(frame.world().resource<SceneAssets>().version)
      .value(std::bit_cast<std::uint32_t>(knobs.bias_units))
      .value(knobs.mip_operator)
      .value(knobs.simplified)
      .digest();
}

/// The regions of the face's map that must be drawn; none when the map is up to date.
std::vector<TexelRect> stale_regions(const ViewShadows& kept, const ShadowFace& face, const FaceContent& content) {
  const CasterHistory& history = kept.history;
  if (kept.cache.holds(face, content)) return {};
  const std::span<const CasterBox> changed = history.changed(face.light);
  if (!kept.cache.held(face, content, history.frame() - 1) || changed.size() > kMostChanges) return {whole_face(face)};
  return covered_regions(face, changed);
}

/// Hash of a background: the resting casters that this part of the face may see.
std::uint64_t hash_of_resting(const ViewShadows& kept, const ShadowFace& face, const TexelRect& texels) {
  const FaceVolume volume = face_volume(face, texels);
  const std::span<const CasterState> states = kept.history.states();
  const std::span<const Entity> withheld = kept.history.withheld(face.light);
  Hasher hasher;
  for (std::size_t i = 0; i < states.size(); ++i)
    if (kept.history.rests(i) && may_see(volume, states[i].box) && !is_withheld(withheld, states[i].entity))
      hasher.value(states[i].hash);
  return hasher.digest();
}

/// Widens a region, so that its background still contains the changed texels while casters keep moving.
TexelRect widened(const ShadowFace& face, const TexelRect& texels) {
  constexpr std::uint32_t kLeast = 16;
  const uvec2 more = glm::max((texels.end - texels.begin) / 4u / kRegionStep * kRegionStep, uvec2(kLeast));
  return {texels.begin - glm::min(texels.begin, more), glm::min(texels.end + more, uvec2(face.square.size))};
}

/// Gives each of the face's regions a background that contains it. Backgrounds that do not exist yet become regions of
/// `made`.
void find_backgrounds(const ViewShadows& kept, DrawnFace& face, DrawnFace& made) {
  constexpr std::size_t kMost = 2 * kMostRegions;
  if (face.regions.front().texels == whole_face(face.face)) return;
  std::vector<FaceBackground>& there = face.backgrounds;
  for (const FaceBackground& background : kept.cache.backgrounds(face.face))
    if (background.hash == hash_of_resting(kept, face.face, background.texels)) there.push_back(background);
  for (DrawnRegion& region : face.regions) {
    region.on_background = true;
    const auto holds = [&](const FaceBackground& background) { return background.texels.contains(region.texels); };
    const auto found = std::find_if(there.begin(), there.end(), holds);
    if (found != there.end()) {
      std::rotate(found, found + 1, there.end());  // moves to the end: recently used
      continue;
    }
    const TexelRect texels = widened(face.face, region.texels);
    there.push_back({texels, hash_of_resting(kept, face.face, texels)});
    made.regions.push_back({texels, {}, {}});
  }
  if (there.size() > kMost) there.erase(there.begin(), there.end() - kMost);
}

/// Which casters draw into a region.
enum class Casters : std::uint8_t { all, resting, restless };

void find_draws(const CasterHistory& history, DrawnFace& face, DrawnRegion& region, std::span<const Caster> casters,
                bool simplified, Casters which) {
  if (face.content.casters == 0) return;
  const bool whole = region.texels == whole_face(face.face);
  const FaceVolume volume = whole ? face_volume(face.face) : face_volume(face.face, region.texels);
  region.draws = face_draws(volume, casters, simplified, history.withheld(face.face.light));
  if (which != Casters::all)
    std::erase_if(region.draws, [&](const FaceDraw& draw) {
      return history.rests(static_cast<std::size_t>(draw.caster - casters.data())) != (which == Casters::resting);
    });
  for (const FaceDraw& draw : region.draws)
    region.matrices.push_back(clip_from_mesh(face.face, draw.caster->world_from_mesh));
}

/// Placed faces, their contents, and the regions that must be drawn.
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
      caster_states(frame.casters().casters, caster_poses(frame.world(), frame.frame_draws()), executor);
  kept.history.advance(std::move(states));
  placed.contents =
      face_contents(placed.faces, kept.history.states(), salt_of(frame, knobs), executor, kept.history.withheld());
  placed.stale.resize(placed.faces.size());
  executor.parallel_for(placed.faces.size(), 8, [&](JobRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i)
      placed.stale[i] = stale_regions(kept, placed.faces[i], placed.contents[i]);
  });
  return placed;
}

}  // namespace

DrawnMaps faces_to_draw(FrameBuilder& frame, ViewShadows& kept, const ShadowViews& views, const ShadowKnobs& knobs) {
  const PlacedFaces placed = placed_faces(frame, kept, views, knobs);
  DrawnMaps maps;
  std::vector<DrawnFace>& drawn = maps.faces;
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
    DrawnFace& added = drawn.emplace_back(DrawnFace{face, content, {}, {}});
    for (const TexelRect& texels : placed.stale[i]) {
      added.regions.push_back({texels, {}, {}});
      kept.counts.texels += texels.texels();
    }
    kept.drawn.push_back({face.light, face.index});
    if (content.casters == 0) ++kept.counts.skipped;
  }
  kept.counts.drawn = static_cast<std::uint32_t>(drawn.size()) - kept.counts.skipped;
  const std::span<const Caster> casters = frame.casters().casters;
  for (const DrawnFace& face : drawn) maps.backgrounds.push_back({face.face, face.content, {}, {}});
  frame.services().executor.parallel_for(drawn.size(), 1, [&](JobRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      DrawnFace &face = drawn[i], &background = maps.backgrounds[i];
      find_backgrounds(kept, face, background);
      for (DrawnRegion& region : face.regions)
        find_draws(kept.history, face, region, casters, knobs.simplified,
                   region.on_background ? Casters::restless : Casters::all);
      for (DrawnRegion& region : background.regions)
        find_draws(kept.history, background, region, casters, knobs.simplified, Casters::resting);
    }
  });
  std::erase_if(maps.backgrounds, [](const DrawnFace& face) { return face.regions.empty(); });
  for (const DrawnFace& face : maps.backgrounds)
    for (const DrawnRegion& region : face.regions) kept.counts.texels += region.texels.texels();
  return maps;
}

}  // namespace gloam

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

/// The parts of one face's map that must be drawn.
struct Stale {
  std::vector<TexelRect> regions;  ///< none when the map is up to date
  bool has_last_map = false;       ///< the atlas holds the map of the frame before
  std::vector<CasterBox> late;     ///< boxes inside which the map waits for its turn (CasterSource::turns)
};

/// Divides the changed boxes into those that are drawn now and those that wait for the face's turn. The latter include
/// boxes that have waited before. place: of the face among the faces of the frame.
struct ChangedBoxes {
  std::vector<CasterBox> now, late;
};

ChangedBoxes divide_by_turn(const ViewMapState& kept, const ShadowFace& face, std::size_t place,
                            std::span<const CasterBox> changed) {
  const std::span<const CasterBox> waited = kept.cache.late(face);
  const FaceVolume volume = face_volume(face);
  ChangedBoxes boxes;
  bool waits = false;
  for (const CasterBox& box : changed) {
    if (box.turns > 1 && !may_see(volume, box)) continue;
    const bool waits_here = box.turns > 1 && (kept.frame.history.frame() + place) % box.turns != 0;
    (waits_here ? boxes.late : boxes.now).push_back(box);
    waits = waits || waits_here;
  }
  std::vector<CasterBox>& others = waits ? boxes.late : boxes.now;
  others.insert(others.end(), waited.begin(), waited.end());
  return boxes;
}

Stale find_stale(const ViewMapState& kept, const ShadowFace& face, std::size_t place, const FaceContent& content) {
  const CasterHistory& history = kept.frame.history;
  if (kept.frame.atlas_is_empty) return {{whole_face(face)}, false};
  if (kept.cache.has_map(face, content)) return {};
  if (!kept.cache.has_map_of_frame(face, content, kept.history.frame())) return {{whole_face(face)}, false};
  const std::span<const CasterBox> changed = history.changed(face.light);
  if (changed.size() > kMostChanges) return {{whole_face(face)}, true};
  ChangedBoxes boxes = divide_by_turn(kept, face, place, changed);
  return {covered_regions(face, boxes.now), true, std::move(boxes.late)};
}

/// Hash of a background: the resting casters that this part of the face may see.
std::uint64_t hash_of_resting(const CasterHistory& history, const ShadowFace& face, const TexelRect& texels) {
  const FaceVolume volume = face_volume(face, texels);
  const std::span<const CasterState> states = history.states();
  const std::span<const Entity> withheld = history.withheld(face.light);
  Hasher hasher;
  for (std::size_t i = 0; i < states.size(); ++i)
    if (history.rests(i) && may_see(volume, states[i].box) && !holds_caster(withheld, states[i].entity))
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
void find_backgrounds(const ViewMapState& kept, DrawnFace& face, DrawnFace& made) {
  constexpr std::size_t kMost = 2 * kMostRegions;
  std::vector<FaceBackground>& there = face.backgrounds;
  for (const FaceBackground& background : kept.cache.backgrounds(face.face))
    if (background.hash == hash_of_resting(kept.frame.history, face.face, background.texels))
      there.push_back(background);
  for (DrawnRegion& region : face.regions) {
    region.on_background = true;
    const auto contains = [&](const FaceBackground& background) { return background.texels.contains(region.texels); };
    const auto found = std::find_if(there.begin(), there.end(), contains);
    if (found != there.end()) {
      std::rotate(found, found + 1, there.end());  // moves to the end: recently used
      continue;
    }
    const TexelRect texels = widened(face.face, region.texels);
    there.push_back({texels, hash_of_resting(kept.frame.history, face.face, texels)});
    made.regions.push_back({texels, {}, {}});
  }
  if (there.size() > kMost) there.erase(there.begin(), there.end() - kMost);
}

/// Which casters draw into a region.
enum class Casters : std::uint8_t { all, resting, restless };

void find_draws(const CasterHistory& history, const MapInputs& inputs, DrawnFace& face, DrawnRegion& region,
                Casters which) {
  if (face.content.casters == 0) return;
  const std::span<const Caster> casters = inputs.casters;
  const std::span<const Entity> withheld = history.withheld(face.face.light);
  const auto draws = [&](std::size_t state) {
    return which == Casters::all || history.rests(state) == (which == Casters::resting);
  };
  const bool whole = region.texels == whole_face(face.face);
  const FaceVolume volume = whole ? face_volume(face.face) : face_volume(face.face, region.texels);
  region.draws = face_draws(face.face, volume, casters, inputs.form, withheld);
  std::erase_if(region.draws,
                [&](const FaceDraw& draw) { return !draws(static_cast<std::size_t>(draw.caster - casters.data())); });
  for (const FaceDraw& draw : region.draws) region.matrices.push_back(clip_from_mesh(face.face, draw));
  for (std::size_t i = 0; i < inputs.sources.size(); ++i) {
    const std::size_t state = casters.size() + i;
    if (draws(state) && may_see(volume, history.states()[state].box) &&
        !holds_caster(withheld, inputs.sources[i]->entity))
      region.sources.push_back(inputs.sources[i]);
  }
}

/// Placed faces, their contents, and the regions that must be drawn.
struct PlacedFaces {
  std::vector<ShadowFace> faces;
  std::vector<FaceContent> contents;
  std::vector<Stale> stale;
};

PlacedFaces place_faces(const MapInputs& inputs, ViewMapState& kept, JobExecutor& executor) {
  PlacedFaces placed;
  for (const ShadowFace& face : inputs.faces)
    if (face.square.size > 0) placed.faces.push_back(face);
  if (!inputs.continues_frame) {
    std::vector<CasterState> states = caster_states(inputs.casters, inputs.poses, executor);
    const std::vector<CasterState> sources = source_states(inputs.sources);
    states.insert(states.end(), sources.begin(), sources.end());
    kept.frame.history = kept.history.advanced(std::move(states), sources.size());
  }
  const CasterHistory& history = kept.frame.history;
  placed.contents = face_contents(placed.faces, history.states(), inputs.salt, executor, history.withheld());
  placed.stale.resize(placed.faces.size());
  executor.parallel_for(placed.faces.size(), 8, [&](JobRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i)
      placed.stale[i] = find_stale(kept, placed.faces[i], i, placed.contents[i]);
  });
  return placed;
}

void begin_frame(const MapInputs& inputs, ViewMapState& kept) {
  kept.frame.atlas_is_empty = inputs.atlas_is_empty;
  kept.frame.committed = false;
  kept.frame.drawn.clear();
  kept.frame.planes.clear();
}

/// Whether the regions of a face are drawn over backgrounds. A whole face would have to be drawn twice, which pays only
/// if it is drawn again in the next frame, over the same background.
bool wants_backgrounds(const DrawnFace& face, bool has_last_map) {
  return has_last_map && (face.content.moving || face.regions.front().texels != whole_face(face.face));
}

}  // namespace

DrawnMaps plan_maps(const MapInputs& inputs, ViewMapState& kept, JobExecutor& executor) {
  if (!inputs.continues_frame) begin_frame(inputs, kept);
  const PlacedFaces placed = place_faces(inputs, kept, executor);
  DrawnMaps maps;
  std::vector<DrawnFace>& drawn = maps.faces;
  std::vector<std::uint8_t> on_backgrounds;  // by index into `drawn`
  kept.counts = {};
  const std::size_t drawn_by_others = kept.frame.drawn.size();
  for (std::size_t i = 0; i < placed.faces.size(); ++i) {
    const ShadowFace& face = placed.faces[i];
    const FaceContent& content = placed.contents[i];
    const FaceKey key{face.light, face.index, face.view};
    const auto others = std::span(kept.frame.drawn).first(drawn_by_others);
    if (std::ranges::find(others, key) != others.end()) {
      ++kept.counts.cached;
      continue;
    }
    if (!placed.stale[i].late.empty()) ++kept.counts.in_turn;
    if (placed.stale[i].regions.empty()) {
      maps.held.push_back({key, content, placed.stale[i].late});
      ++kept.counts.cached;
      continue;
    }
    DrawnFace& added = drawn.emplace_back(DrawnFace{face, content, {}, {}, placed.stale[i].late});
    for (const TexelRect& texels : placed.stale[i].regions) {
      added.regions.push_back({texels, {}, {}});
      kept.counts.texels += texels.texels();
    }
    on_backgrounds.push_back(wants_backgrounds(added, placed.stale[i].has_last_map) ? 1 : 0);
    kept.frame.drawn.push_back(key);
    if (content.casters == 0) ++kept.counts.skipped;
  }
  kept.counts.drawn = static_cast<std::uint32_t>(drawn.size()) - kept.counts.skipped;
  for (const DrawnFace& face : drawn) maps.backgrounds.push_back({face.face, face.content, {}, {}});
  executor.parallel_for(drawn.size(), 1, [&](JobRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      DrawnFace &face = drawn[i], &background = maps.backgrounds[i];
      if (on_backgrounds[i] != 0) find_backgrounds(kept, face, background);
      for (DrawnRegion& region : face.regions)
        find_draws(kept.frame.history, inputs, face, region, region.on_background ? Casters::restless : Casters::all);
      for (DrawnRegion& region : background.regions)
        find_draws(kept.frame.history, inputs, background, region, Casters::resting);
    }
  });
  std::erase_if(maps.backgrounds, [](const DrawnFace& face) { return face.regions.empty(); });
  for (const DrawnFace& face : maps.backgrounds)
    for (const DrawnRegion& region : face.regions) kept.counts.texels += region.texels.texels();
  for (const std::vector<DrawnFace>* list : {&maps.backgrounds, &drawn})
    for (const DrawnFace& face : *list)
      for (const DrawnRegion& region : face.regions)
        for (const FaceDraw& draw : region.draws) kept.counts.triangles += draw.index_count / 3;
  return maps;
}

std::uint64_t map_salt(const FrameBuilder& frame, const ShadowKnobs& knobs) {
  return Hasher()
      .value(frame.world().resource<SceneAssets>().version)
      .value(std::bit_cast<std::uint32_t>(knobs.bias_units))
      .value(knobs.mip_operator)
      .value(knobs.simplified)
      .value(std::bit_cast<std::uint32_t>(knobs.lod_texels))
      .value(knobs.subsurface_backs)
      .digest();
}

void commit_maps(std::span<const DrawnFace> drawn, std::span<const HeldFace> held, ViewMapState& kept) {
  if (!kept.frame.committed) {
    if (kept.frame.atlas_is_empty) {
      kept.cache.clear();
      kept.has_backgrounds = false;
    }
    kept.history = std::move(kept.frame.history);
    kept.frame.committed = true;
  }
  for (const HeldFace& face : held) kept.cache.keep(face.face, face.content, kept.history.frame(), face.late);
  for (const DrawnFace& face : drawn) {
    kept.cache.set_drawn(face.face, face.content, kept.history.frame());
    if (!face.late.empty())
      kept.cache.keep({face.face.light, face.face.index, face.face.view}, face.content, kept.history.frame(),
                      face.late);
    kept.cache.set_backgrounds(face.face, face.backgrounds);
  }
}

DrawnMaps faces_to_draw(FrameBuilder& frame, ViewMapState& kept, const ViewFaces& view_faces, const ShadowKnobs& knobs,
                        bool atlas_is_empty) {
  const std::vector<std::uint64_t> poses = caster_poses(frame.world(), frame.frame_draws());
  // If casters of the main view are withheld that were not when its companions drew, their maps are drawn again.
  const bool same_frame = kept.frame.number == frame.graph().frame();
  const bool continues_frame = same_frame && kept.frame.history.withheld() == kept.history.next_withheld();
  const MapInputs inputs{.faces = view_faces.faces,
                         .casters = frame.casters().casters,
                         .poses = poses,
                         .sources = frame.caster_sources(),
                         .salt = map_salt(frame, knobs),
                         .form = {knobs.simplified, knobs.subsurface_backs, knobs.lod_texels},
                         .continues_frame = continues_frame,
                         .atlas_is_empty = atlas_is_empty};
  kept.frame.number = frame.graph().frame();
  return plan_maps(inputs, kept, frame.services().executor);
}

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <map>
#include <utility>

#include "engine/core/hash.h"
#include "engine/render/worlds/world_id.h"
#include "modules/shadows/atlas/caster_states.h"
#include "modules/shadows/atlas/drawn_faces.h"
#include "modules/shadows/atlas/mip_places.h"
#include "modules/shadows/maps/tools.h"
#include "modules/shadows/outputs.h"

namespace gloam {
namespace {

FaceKey key_of(const ExtraMap& map) { return {map.face.light, map.face.index, map.face.view}; }

/// The states of the casters and sources whose entity is in `entities`. poses: of all casters.
std::vector<CasterState> states_of(FrameBuilder& frame, std::span<const Entity> entities,
                                   std::span<const std::uint64_t> poses) {
  std::vector<Caster> casters;
  std::vector<std::uint64_t> their_poses;
  const std::vector<Caster>& all = frame.casters().casters;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!holds_caster(entities, all[i].entity)) continue;
    casters.push_back(all[i]);
    their_poses.push_back(poses[i]);
  }
  std::vector<CasterState> states = caster_states(casters, their_poses, frame.services().executor);
  std::vector<const CasterSource*> sources;
  for (const CasterSource* source : frame.caster_sources())
    if (holds_caster(entities, source->entity)) sources.push_back(source);
  for (CasterState& state : source_states(sources)) states.push_back(state);
  return states;
}

/// The content of each map.
std::vector<FaceContent> contents_of(FrameBuilder& frame, std::span<const ExtraMap> maps, std::uint64_t salt) {
  const std::vector<std::uint64_t> poses = caster_poses(frame.world(), frame.frame_draws());
  std::vector<FaceContent> contents;
  for (const ExtraMap& map : maps)
    contents.push_back(
        face_contents(std::span(&map.face, 1), states_of(frame, map.casters, poses), salt, frame.services().executor)
            .front());
  return contents;
}

/// The place that the last frame gave a map of this size.
AtlasSquare last_place(const ExtraMapState& state, const ExtraMap& map) {
  const auto found = std::ranges::find(state.places, key_of(map), [](const auto& place) { return place.first; });
  return found != state.places.end() && found->second.size == map.face.square.size ? found->second : AtlasSquare{};
}

/// Finds squares for maps without one in an atlas with a side of `size`. False if one of them finds none.
bool fill_places(std::span<const ExtraMap> maps, std::uint32_t size, std::vector<AtlasSquare>& squares) {
  std::vector<AtlasSquare> taken;
  for (const AtlasSquare& square : squares)
    if (square.size > 0) taken.push_back(square);
  FreeSquares free(size, taken);
  bool all = true;
  for (std::size_t i = 0; i < maps.size(); ++i) {
    if (squares[i].size == 0) squares[i] = free.take(maps[i].face.square.size);
    all = all && squares[i].size > 0;
  }
  return all;
}

/// The squares of all maps: the last ones, if the others then find room. Otherwise the maps are placed anew, the
/// largest first, which leaves no gaps.
std::vector<AtlasSquare> places_of(std::span<const ExtraMap> maps, const ExtraMapState& state, std::uint32_t size) {
  std::vector<AtlasSquare> squares;
  for (const ExtraMap& map : maps) squares.push_back(state.size == size ? last_place(state, map) : AtlasSquare{});
  std::vector<AtlasSquare> filled = squares;
  if (fill_places(maps, size, filled)) return filled;
  std::uint64_t texels = 0;
  for (const ExtraMap& map : maps) texels += std::uint64_t{map.face.square.size} * map.face.square.size;
  if (texels > std::uint64_t{size} * size) return filled;
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < maps.size(); ++i) order.push_back(i);
  std::ranges::stable_sort(order, std::ranges::greater(), [&](std::size_t i) { return maps[i].face.square.size; });
  FreeSquares free(size, {});
  for (const std::size_t i : order) squares[i] = free.take(maps[i].face.square.size);
  return squares;
}

/// The least side of an atlas that may hold the maps, at most `most`.
std::uint32_t side_for(std::span<const ExtraMap> maps, std::uint32_t most, ExtraMapState& state) {
  std::vector<FaceRequest> requests;
  for (const ExtraMap& map : maps) requests.push_back({key_of(map), map.face.square.size, 0.0f});
  return state.side.next(requests, false, most);
}

struct KeptAtlas {
  ExtraAtlas atlas;
  bool filled = false;  ///< it holds what the last frame left
};

KeptAtlas use_atlas(FrameBuilder& frame, const ShadowKnobs& knobs, std::uint32_t size) {
  KeptAtlas kept{{{}, {}, size}, true};
  gpu::ImageDesc desc;
  desc.module = frame.module();
  desc.usage = gpu::ImageUsage::sampled | gpu::ImageUsage::storage | gpu::ImageUsage::transfer_source;
  const auto use = [&](const char* name, gpu::Format format, uvec2 extent) -> ImageRef {
    desc.name = desc.module + name;
    desc.format = format;
    desc.width = extent.x;
    desc.height = extent.y;
    const auto image = frame.history_image(desc, {});
    if (!frame.check(image)) return {};
    kept.filled = kept.filled && image->filled();
    return image->image;
  };
  kept.atlas.atlas = use("_atlas", knobs.d16 ? gpu::Format::r16_unorm : gpu::Format::r32_float, size_with_mips(size));
  // Nearest depths above farthest ones.
  const uvec2 pyramid = size_with_mips(size >> GLOAM_SHADOW_PYRAMID_MIP) * uvec2(1, 2);
  kept.atlas.pyramid = use("_pyramid", gpu::Format::r32_float, pyramid);
  return kept;
}

}  // namespace

KeptMaps ShadowMapDrawer::draw_kept(FrameBuilder& frame, const char* name, std::span<const ExtraMap> maps,
                                    std::uint32_t size, MapMips mips) const {
  ExtraMapState& state = tools_->states.extra_maps(world_id(frame.world()), frame.view().id);
  const KeptAtlas used = use_atlas(frame, tools_->knobs, side_for(maps, size, state));
  if (!frame.status().ok()) return {};
  KeptMaps kept{used.atlas, places_of(maps, state, used.atlas.size), 0};
  const std::uint64_t salt = Hasher().value(map_salt(frame, tools_->knobs)).value(mips).digest();
  const std::vector<FaceContent> contents = contents_of(frame, maps, salt);
  std::vector<DrawnFace> drawn;
  std::vector<std::pair<FaceKey, AtlasSquare>> places;
  std::map<std::uint32_t, std::vector<ExtraMap>> by_size;
  for (std::size_t i = 0; i < maps.size(); ++i) {
    if (kept.squares[i].size == 0) continue;
    ExtraMap map = maps[i];
    map.face.square = kept.squares[i];
    places.emplace_back(key_of(map), map.face.square);
    if (used.filled && state.cache.has_map(map.face, contents[i])) continue;
    by_size[map.face.square.size].push_back(map);
    drawn.push_back({map.face, contents[i], {}, {}});
  }
  kept.drawn = static_cast<std::uint32_t>(drawn.size());
  for (const auto& [texels, of_size] : by_size)
    for (std::size_t first = 0; first < of_size.size(); first += most_maps(texels)) {
      const std::size_t count = std::min(of_size.size() - first, most_maps(texels));
      draw(frame, name, std::span(of_size).subspan(first, count), kept.atlas, mips);
    }
  frame.on_commit([&state, drawn = std::move(drawn), places = std::move(places), filled = used.filled,
                   side = used.atlas.size]() mutable {
    if (!filled) state.cache.clear();
    state.size = side;
    state.places = std::move(places);
    for (const DrawnFace& face : drawn) state.cache.set_drawn(face.face, face.content, 0);
  });
  return kept;
}

}  // namespace gloam

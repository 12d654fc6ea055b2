// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/atlas/cache.h"

#include <bit>
#include <iterator>
#include <utility>

#include "engine/core/hash.h"
#include "modules/shadows/atlas/face_casters.h"

namespace gloam {
namespace {

void add(Hasher& hasher, float value) { hasher.value(std::bit_cast<std::uint32_t>(value)); }
void add(Hasher& hasher, double value) { hasher.value(std::bit_cast<std::uint64_t>(value)); }
void add(Hasher& hasher, const vec3& v) {
  for (int i = 0; i < 3; ++i) add(hasher, v[i]);
}
void add(Hasher& hasher, const dvec3& v) {
  for (int i = 0; i < 3; ++i) add(hasher, v[i]);
}

std::uint64_t hash_of(const ShadowFace& face) {
  Hasher hasher;
  add(hasher, face.origin);
  for (const vec3& axis : {face.right, face.up, face.forward}) add(hasher, axis);
  for (const float value :
       {face.tan_half, face.half_extent_m, face.near_m, face.clip_share, face.far_m, face.bulb_radius_m})
    add(hasher, value);
  hasher.value(face.square.size);
  return hasher.digest();
}

/// Spreads the bits of x: bit i moves to bit 2 i.
std::uint64_t spread_bits(std::uint32_t x) {
  std::uint64_t bits = x;
  bits = (bits | bits << 16) & 0x0000FFFF0000FFFF;
  bits = (bits | bits << 8) & 0x00FF00FF00FF00FF;
  bits = (bits | bits << 4) & 0x0F0F0F0F0F0F0F0F;
  bits = (bits | bits << 2) & 0x3333333333333333;
  return (bits | bits << 1) & 0x5555555555555555;
}

std::uint64_t place_of(const AtlasSquare& square) {
  return spread_bits(square.origin.x) | spread_bits(square.origin.y) << 1;
}

FaceKey key_of(const ShadowFace& face) { return {face.light, face.index, face.view}; }

/// Adjacent faces of one light with one origin and range, or one orthographic face: [begin, end).
struct FaceGroup {
  std::size_t begin = 0;
  std::size_t end = 0;
};

std::vector<FaceGroup> groups_of(std::span<const ShadowFace> faces) {
  std::vector<FaceGroup> groups;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const bool joins = f > 0 && faces[f].light == faces[f - 1].light && faces[f].tan_half > 0.0f &&
                       faces[f - 1].tan_half > 0.0f && faces[f].origin == faces[f - 1].origin &&
                       faces[f].far_m == faces[f - 1].far_m;
    if (!joins) groups.push_back({f, f});
    groups.back().end = f + 1;
  }
  return groups;
}

/// Indices of casters within the range of a group's faces: a superset of the casters for which may_see() is true in any
/// of them.
std::vector<std::uint32_t> casters_in_reach(const ShadowFace& face, std::span<const CasterState> casters) {
  constexpr double kSlack = 1e-4;  // above the float rounding of may_see(), as a share of the lengths involved
  const bool everywhere = !(face.tan_half > 0.0f && face.far_m > 0.0f);
  std::vector<std::uint32_t> found;
  for (std::uint32_t i = 0; i < casters.size(); ++i) {
    const dvec3 low = casters[i].box.low - face.origin, high = casters[i].box.high - face.origin;
    const dvec3 nearest = glm::max(glm::max(low, -high), dvec3(0.0));
    const dvec3 farthest = glm::max(glm::abs(low), glm::abs(high));
    const double reach = face.far_m + kSlack * (face.far_m + farthest.x + farthest.y + farthest.z);
    // Casters with unknown bounds or NaN count as in range.
    if (everywhere || !(low.x <= high.x) || !(glm::dot(nearest, nearest) > reach * reach)) found.push_back(i);
  }
  return found;
}

}  // namespace

std::vector<FaceContent> face_contents(std::span<const ShadowFace> faces, std::span<const CasterState> casters,
                                       std::uint64_t salt, JobExecutor& executor, const WithheldCasters& withheld) {
  std::vector<FaceContent> contents(faces.size());
  const std::vector<FaceGroup> groups = groups_of(faces);
  executor.parallel_for(groups.size(), 4, [&](JobRange range) {
    for (std::size_t g = range.begin; g < range.end; ++g) {
      std::vector<std::uint32_t> reached = casters_in_reach(faces[groups[g].begin], casters);
      if (const std::span<const Entity> left_out = withheld.of(faces[groups[g].begin].light); !left_out.empty())
        std::erase_if(reached, [&](std::uint32_t i) { return holds_caster(left_out, casters[i].entity); });
      for (std::size_t f = groups[g].begin; f < groups[g].end; ++f) {
        const FaceVolume volume = face_volume(faces[f]);
        FaceContent& content = contents[f];
        content.pose = Hasher().value(salt).value(hash_of(faces[f])).digest();
        Hasher hasher;
        hasher.value(content.pose);
        for (const std::uint32_t i : reached) {
          if (!may_see(volume, casters[i].box)) continue;
          hasher.value(casters[i].hash);
          content.moving = content.moving || casters[i].unsteady;
          ++content.casters;
        }
        content.hash = hasher.digest();
      }
    }
  });
  return contents;
}

bool ShadowCache::has_map(const ShadowFace& face, const FaceContent& content) const {
  if (content.moving) return false;
  const auto found = maps_.find(key_of(face));
  return found != maps_.end() && found->second.square == face.square && found->second.content == content &&
         found->second.late.empty();
}

bool ShadowCache::has_map_of_frame(const ShadowFace& face, const FaceContent& content, std::uint64_t frame) const {
  const auto found = maps_.find(key_of(face));
  return found != maps_.end() && found->second.square == face.square && found->second.content.pose == content.pose &&
         found->second.frame == frame && frame > 0;
}

void ShadowCache::keep(const FaceKey& face, const FaceContent& content, std::uint64_t frame,
                       std::vector<CasterBox> late) {
  const auto found = maps_.find(face);
  if (found == maps_.end()) return;
  found->second.content = content;
  found->second.frame = frame;
  found->second.late = std::move(late);
}

std::uint64_t ShadowCache::version(const FaceKey& face) const {
  const auto found = maps_.find(face);
  return found == maps_.end() ? 0 : found->second.version;
}

std::span<const CasterBox> ShadowCache::late(const ShadowFace& face) const {
  const auto found = maps_.find(key_of(face));
  if (found == maps_.end()) return {};
  return found->second.late;
}

void ShadowCache::forget_overlapping(const AtlasSquare& square) {
  const std::uint64_t begin = place_of(square), end = begin + std::uint64_t{square.size} * square.size;
  auto at = places_.upper_bound(begin);
  if (at != places_.begin() && std::prev(at)->second.end > begin) --at;
  while (at != places_.end() && at->first < end) {
    maps_.erase(at->second.key);
    at = places_.erase(at);
  }
}

void ShadowCache::set_drawn(const ShadowFace& face, const FaceContent& content, std::uint64_t frame) {
  const FaceKey key = key_of(face);
  if (const auto before = maps_.find(key); before != maps_.end()) places_.erase(place_of(before->second.square));
  forget_overlapping(face.square);
  Map& map = maps_.insert_or_assign(key, Map{face.square, content, frame, {}}).first->second;
  map.version = ++drawings_;
  const std::uint64_t place = place_of(face.square);
  places_[place] = {place + std::uint64_t{face.square.size} * face.square.size, key};
}

std::span<const FaceBackground> ShadowCache::backgrounds(const ShadowFace& face) const {
  const auto found = maps_.find(key_of(face));
  if (found == maps_.end()) return {};
  return found->second.backgrounds;
}

void ShadowCache::set_backgrounds(const ShadowFace& face, std::vector<FaceBackground> backgrounds) {
  maps_.at(key_of(face)).backgrounds = std::move(backgrounds);
}

bool ShadowCache::has_planes(const ShadowFace& face) const {
  const auto found = maps_.find(key_of(face));
  return found != maps_.end() && found->second.square == face.square && found->second.has_planes;
}

void ShadowCache::set_planes(const FaceKey& face) {
  if (const auto found = maps_.find(face); found != maps_.end()) found->second.has_planes = true;
}

void ShadowCache::forget_planes() {
  for (auto& [key, map] : maps_) map.has_planes = false;
}

}  // namespace gloam

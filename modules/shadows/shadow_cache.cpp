// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/shadow_cache.h"

#include <bit>

#include "engine/core/hash.h"
#include "modules/shadows/face_casters.h"

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

/// Where the caster is and what it is made of; the meshes' and materials' own content has a version, which is part of the salt.
std::uint64_t hash_of(const Caster& caster) {
  Hasher hasher;
  hasher.value(caster.primitive->first_index).value(caster.primitive->first_vertex).value(caster.primitive->material);
  hasher.value(caster.variant.features);
  for (int column = 0; column < 4; ++column) add(hasher, dvec3(caster.world_from_mesh[column]));
  return hasher.digest();
}

std::uint64_t hash_of(const ShadowFace& face) {
  Hasher hasher;
  add(hasher, face.origin);
  for (const vec3& axis : {face.right, face.up, face.forward}) add(hasher, axis);
  for (const float value : {face.tan_half, face.half_extent_m, face.near_m, face.far_m}) add(hasher, value);
  hasher.value(face.square.size);
  return hasher.digest();
}

bool overlap(const AtlasSquare& a, const AtlasSquare& b) {
  return a.origin.x < b.origin.x + b.size && b.origin.x < a.origin.x + a.size && a.origin.y < b.origin.y + b.size &&
         b.origin.y < a.origin.y + a.size;
}

FaceKey key_of(const ShadowFace& face) { return {face.light, face.index}; }

}  // namespace

std::vector<FaceContent> face_contents(std::span<const ShadowFace> faces, std::span<const Caster> casters,
                                       std::uint64_t salt, JobExecutor& executor) {
  std::vector<std::uint64_t> hashes(casters.size());
  executor.parallel_for(casters.size(), 256, [&](JobRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i) hashes[i] = hash_of(casters[i]);
  });
  std::vector<FaceContent> contents(faces.size());
  executor.parallel_for(faces.size(), 4, [&](JobRange range) {
    for (std::size_t f = range.begin; f < range.end; ++f) {
      const FaceVolume volume = face_volume(faces[f]);
      FaceContent& content = contents[f];
      Hasher hasher;
      hasher.value(salt).value(hash_of(faces[f]));
      for (std::size_t i = 0; i < casters.size(); ++i) {
        if (!may_see(volume, casters[i])) continue;
        hasher.value(hashes[i]);
        content.moving = content.moving || casters[i].moving;
        ++content.casters;
      }
      content.hash = hasher.digest();
    }
  });
  return contents;
}

bool ShadowCache::holds(const ShadowFace& face, const FaceContent& content) const {
  if (content.moving) return false;
  const auto found = maps_.find(key_of(face));
  return found != maps_.end() && found->second.square == face.square && found->second.content == content;
}

void ShadowCache::set_drawn(const ShadowFace& face, const FaceContent& content) {
  std::erase_if(maps_, [&](const auto& map) { return overlap(map.second.square, face.square); });
  maps_[key_of(face)] = {face.square, content};
}

}  // namespace gloam

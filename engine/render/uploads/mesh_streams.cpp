// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/uploads/mesh_streams.h"

#include <algorithm>
#include <initializer_list>
#include <string>
#include <utility>

#include "engine/core/assert.h"

namespace gloam {
namespace {

/// Elements of a unit: the byte offset of every range is then aligned for binding.
constexpr std::uint64_t kUnit = 64;
constexpr std::uint64_t kLeastBytes = 256;  // of a buffer whose stream is empty

constexpr const char* kNames[] = {"positions", "frames", "surfaces", "indices", "influences", "morph_offsets"};
constexpr std::uint64_t kElementBytes[] = {sizeof(vec3),          sizeof(PackedFrame),     sizeof(PackedSurface),
                                           sizeof(std::uint32_t), sizeof(PackedInfluence), sizeof(float)};

std::uint64_t units(std::size_t count) { return (count + kUnit - 1) / kUnit; }

template <class T>
AssetUploads::BufferPart part_of(MeshStreams::Stream stream, std::uint32_t first, const std::vector<T>& values) {
  const auto bytes = std::as_bytes(std::span(values));
  return {stream, first * kElementBytes[stream], {bytes.begin(), bytes.end()}};
}

}  // namespace

const RangeAllocator& MeshStreams::ranges_of(Stream stream) const {
  const RangeAllocator* const ranges[] = {&vertices_,     &vertices_,         &vertices_,
                                          &index_ranges_, &influence_ranges_, &morph_ranges_};
  return *ranges[stream];
}

std::uint64_t MeshStreams::bytes(Stream stream) const {
  return ranges_of(stream).capacity() * kUnit * kElementBytes[stream];
}

std::uint32_t MeshStreams::allocate(RangeAllocator& ranges, std::size_t count, bool spare) {
  const std::uint64_t wanted = units(count);
  if (wanted == 0) return 0;
  std::optional<std::uint64_t> first = ranges.allocate(wanted);
  if (!first) {
    const std::uint64_t enough = ranges.capacity() + wanted - ranges.free_at_end();
    ranges.grow(spare ? std::max(enough, ranges.capacity() * 3 / 2) : enough);
    first = ranges.allocate(wanted);
  }
  return static_cast<std::uint32_t>(*first * kUnit);
}

void MeshStreams::free(RangeAllocator& ranges, std::uint32_t first, std::size_t count) {
  if (count > 0) ranges.free(first / kUnit);
}

void MeshStreams::place(PackedPrimitive& packed, bool spare) {
  GpuPrimitive& primitive = packed.primitive;
  primitive.first_vertex = allocate(vertices_, packed.positions.size(), spare);
  primitive.first_index = allocate(index_ranges_, packed.indices.size(), spare);
  primitive.first_influence = allocate(influence_ranges_, packed.influences.size(), spare);
  primitive.first_morph = allocate(morph_ranges_, packed.morph_offsets.size(), spare);
  primitive.morph_floats = static_cast<std::uint32_t>(packed.morph_offsets.size());
  place_simplified(primitive, packed.simplified.size(), spare);
}

void MeshStreams::place_simplified(GpuPrimitive& primitive, std::size_t count, bool spare) {
  primitive.simplified_first_index = allocate(index_ranges_, count, spare);
  primitive.simplified_index_count = static_cast<std::uint32_t>(count);
}

void MeshStreams::place_levels(DetailLevels& levels, bool spare) {
  levels.first_index = allocate(index_ranges_, levels.index_count, spare);
}

void MeshStreams::remove(const GpuPrimitive& primitive) {
  free(vertices_, primitive.first_vertex, primitive.vertex_count);
  free(index_ranges_, primitive.first_index, primitive.index_count);
  free(influence_ranges_, primitive.first_influence, primitive.skinned ? primitive.vertex_count : 0);
  free(morph_ranges_, primitive.first_morph, primitive.morph_floats);
  free(index_ranges_, primitive.simplified_first_index, primitive.simplified_index_count);
  for (const DetailLevels& levels : primitive.detail) free(index_ranges_, levels.first_index, levels.index_count);
}

Status MeshStreams::fit() {
  for (std::uint32_t i = 0; i < kStreams; ++i) {
    const auto stream = static_cast<Stream>(i);
    if (ranges_of(stream).capacity() * kUnit > ~0u)
      return Error{ErrorKind::failed, std::string("the scene's meshes have more ") + kNames[i] + " than 32 bits count"};
    const std::uint64_t size = std::max(bytes(stream), kLeastBytes);
    if (buffers_[i] && device_.desc(buffers_[i]).size >= size) continue;
    gpu::BufferDesc desc{.name = std::string("scene.") + kNames[i], .module = "engine", .size = size};
    desc.usage = gpu::BufferUsage::transfer_target | gpu::BufferUsage::transfer_source | gpu::BufferUsage::storage |
                 (stream == indices ? gpu::BufferUsage::index : gpu::BufferUsage::vertex);
    const auto larger = device_.create_buffer(desc);
    if (!larger.ok()) return larger.error();
    const gpu::BufferHandle smaller = std::exchange(buffers_[i], *larger);
    if (!smaller) continue;
    if (replaced_[i])
      device_.destroy(smaller);  // grew twice before a copy
    else
      replaced_[i] = smaller;
  }
  return {};
}

bool MeshStreams::is_sparse() const {
  constexpr std::uint64_t kLeastWaste = 1 << 20;
  std::uint64_t all = 0, used = 0;
  for (std::uint32_t i = 0; i < kStreams; ++i) {
    all += bytes(static_cast<Stream>(i));
    used += ranges_of(static_cast<Stream>(i)).used() * kUnit * kElementBytes[i];
  }
  return all - used > std::max(used, kLeastWaste);
}

Status MeshStreams::compact(std::span<GpuPrimitive* const> primitives) {
  GLOAM_ASSERT(!has_growth(), "buffers are compacted when their contents are complete");
  vertices_ = index_ranges_ = influence_ranges_ = morph_ranges_ = {};
  const auto move = [&](RangeAllocator& ranges, std::uint32_t& first, std::size_t count,
                        std::initializer_list<Stream> streams) {
    const std::uint32_t from = std::exchange(first, allocate(ranges, count, false));
    if (count == 0) return;
    for (const Stream stream : streams) moves_[stream].push_back({from, first, count});
  };
  for (GpuPrimitive* const p : primitives) {
    move(vertices_, p->first_vertex, p->vertex_count, {positions, frames, surfaces});
    move(index_ranges_, p->first_index, p->index_count, {indices});
    move(influence_ranges_, p->first_influence, p->skinned ? p->vertex_count : 0, {influences});
    move(morph_ranges_, p->first_morph, p->morph_floats, {morph_offsets});
    move(index_ranges_, p->simplified_first_index, p->simplified_index_count, {indices});
    for (DetailLevels& levels : p->detail) move(index_ranges_, levels.first_index, levels.index_count, {indices});
  }
  for (std::uint32_t i = 0; i < kStreams; ++i) replaced_[i] = std::exchange(buffers_[i], {});
  GLOAM_TRY(fit());
  // Nothing moves from an empty stream.
  for (std::uint32_t i = 0; i < kStreams; ++i)
    if (moves_[i].empty()) device_.destroy(std::exchange(replaced_[i], {}));
  return {};
}

bool MeshStreams::has_growth() const {
  return std::ranges::any_of(replaced_, [](gpu::BufferHandle buffer) { return static_cast<bool>(buffer); });
}

void MeshStreams::record_growth(gpu::CommandList& commands) {
  std::vector<gpu::BufferBarrier> before, after;
  for (std::uint32_t i = 0; i < kStreams; ++i) {
    if (!replaced_[i]) continue;
    before.push_back({replaced_[i], kAccess, gpu::Access::transfer_read, kAlso, 0});
    after.push_back({buffers_[i], gpu::Access::transfer_write, kAccess, 0, kAlso});
  }
  if (before.empty()) return;
  commands.barrier(before, {});
  for (std::uint32_t i = 0; i < kStreams; ++i) {
    if (!replaced_[i]) continue;
    if (moves_[i].empty()) commands.copy_buffer(replaced_[i], 0, buffers_[i], 0, device_.desc(replaced_[i]).size);
    for (const Move& move : moves_[i])
      commands.copy_buffer(replaced_[i], move.from * kElementBytes[i], buffers_[i], move.to * kElementBytes[i],
                           move.count * kElementBytes[i]);
    moves_[i].clear();
    device_.destroy(std::exchange(replaced_[i], {}));
  }
  commands.barrier(after, {});
}

AssetUploads::BufferPart MeshStreams::simplified_part(const GpuPrimitive& primitive,
                                                      const std::vector<std::uint32_t>& simplified) {
  return part_of(indices, primitive.simplified_first_index, simplified);
}

AssetUploads::BufferPart MeshStreams::levels_part(const DetailLevels& levels, const std::vector<std::uint32_t>& made) {
  return part_of(indices, levels.first_index, made);
}

std::vector<AssetUploads::BufferPart> MeshStreams::parts(const PackedPrimitive& packed, std::uint32_t stream) {
  const GpuPrimitive& p = packed.primitive;
  switch (static_cast<Stream>(stream)) {
    case positions:
      return {part_of(positions, p.first_vertex, packed.positions)};
    case frames:
      return {part_of(frames, p.first_vertex, packed.frames)};
    case surfaces:
      return {part_of(surfaces, p.first_vertex, packed.surfaces)};
    case indices:
      return {part_of(indices, p.first_index, packed.indices), simplified_part(p, packed.simplified)};
    case influences:
      return {part_of(influences, p.first_influence, packed.influences)};
    case morph_offsets:
      return {part_of(morph_offsets, p.first_morph, packed.morph_offsets)};
  }
  return {};
}

void MeshStreams::release() {
  for (auto* buffers : {&buffers_, &replaced_})
    for (gpu::BufferHandle& buffer : *buffers)
      if (buffer) device_.destroy(std::exchange(buffer, {}));
  for (std::vector<Move>& moves : moves_) moves.clear();
  vertices_ = index_ranges_ = influence_ranges_ = morph_ranges_ = {};
}

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/scene/simplified_casters.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <utility>

#include "engine/render/scene/gpu_scene.h"

namespace gloam {
namespace {

constexpr std::size_t kFewestIndices =
    std::size_t{3} * 32;  ///< smaller meshes are not drawn faster with fewer triangles

/// A primitive's indices as GpuScene::sync uploads them, and those of the simplified caster.
struct CasterIndices {
  std::vector<std::uint32_t> full;
  std::vector<std::uint32_t> simplified;
};

CasterIndices caster_indices(const Primitive& source, bool simplify) {
  CasterIndices made;
  static_cast<void>(build_clusters(source, made.full));
  std::uint32_t count = 0;
  const std::vector<std::uint32_t> place = fetch_order(source.positions.size(), made.full, count);
  if (!simplify) return made;
  std::vector<vec3> positions(count);
  for (std::size_t v = 0; v < place.size(); ++v)
    if (place[v] != kNone) positions[place[v]] = source.positions[v];
  made.simplified = simplified_indices(positions, made.full);
  return made;
}

}  // namespace

std::vector<std::uint32_t> simplified_indices(std::span<const vec3> positions, std::span<const std::uint32_t> indices) {
  if (indices.size() < kFewestIndices) return {};
  std::vector<std::uint32_t> merged(indices.size());
  meshopt_generateShadowIndexBuffer(merged.data(), indices.data(), indices.size(), &positions[0].x, positions.size(),
                                    sizeof(vec3), sizeof(vec3));
  // The simplifier treats vertices at one position as a seam, even unused ones, so it gets only the used vertices.
  std::uint32_t count = 0;
  const std::vector<std::uint32_t> place = fetch_order(positions.size(), merged, count);
  std::vector<vec3> used(count);
  std::vector<std::uint32_t> original(count);
  for (std::uint32_t v = 0; v < place.size(); ++v) {
    if (place[v] == kNone) continue;
    used[place[v]] = positions[v];
    original[place[v]] = v;
  }
  const float side = meshopt_simplifyScale(&used[0].x, used.size(), sizeof(vec3));
  if (!(side > 0.0f)) return {};
  const float error = std::max(kSimplifiedShare, kSimplifiedError_m / side);
  std::vector<std::uint32_t> fewer(indices.size());
  fewer.resize(meshopt_simplify(fewer.data(), merged.data(), merged.size(), &used[0].x, used.size(), sizeof(vec3), 0,
                                error, meshopt_SimplifyLockBorder, nullptr));
  if (fewer.size() > indices.size() / 10 * 9) return {};
  for (std::uint32_t& index : fewer) index = original[index];
  return fewer;
}

Status GpuScene::simplify_casters(const SceneAssets& assets, JobExecutor& executor) {
  GLOAM_ASSERT(version_ == assets.version, "casters of the assets that sync has uploaded are simplified");
  if (casters_simplified_) return {};
  std::vector<std::pair<const Primitive*, GpuPrimitive*>> primitives;
  for (std::size_t m = 0; m < meshes_.size(); ++m)
    for (std::size_t p = 0; p < meshes_[m].size(); ++p)
      primitives.emplace_back(&assets.meshes[m].primitives[p], &meshes_[m][p]);
  std::vector<CasterIndices> made(primitives.size());
  executor.parallel_for(primitives.size(), 1, [&](JobRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      const GpuPrimitive& primitive = *primitives[i].second;
      const bool rigid = !primitive.skinned && primitive.morph_targets == 0;
      made[i] =
          caster_indices(*primitives[i].first, rigid && materials_[primitive.material].alpha_mode == AlphaMode::opaque);
    }
  });

  const std::size_t end = device_.desc(indices()).size / sizeof(std::uint32_t);
  std::vector<std::byte> bytes(end * sizeof(std::uint32_t));
  std::vector<std::uint32_t> firsts;
  for (std::size_t i = 0; i < made.size(); ++i) {
    const auto full = std::as_bytes(std::span(made[i].full)), simplified = std::as_bytes(std::span(made[i].simplified));
    std::ranges::copy(
        full, bytes.begin() + static_cast<std::ptrdiff_t>(primitives[i].second->first_index * sizeof(std::uint32_t)));
    firsts.push_back(static_cast<std::uint32_t>(bytes.size() / sizeof(std::uint32_t)));
    bytes.insert(bytes.end(), simplified.begin(), simplified.end());
  }
  if (bytes.size() > end * sizeof(std::uint32_t)) GLOAM_TRY(replace_indices(std::move(bytes), executor));
  for (std::size_t i = 0; i < made.size(); ++i) {
    primitives[i].second->simplified_first_index = firsts[i];
    primitives[i].second->simplified_index_count = static_cast<std::uint32_t>(made[i].simplified.size());
  }
  casters_simplified_ = true;
  return {};
}

Status GpuScene::replace_indices(std::vector<std::byte> bytes, JobExecutor& executor) {
  gpu::BufferDesc desc = device_.desc(indices());
  desc.size = bytes.size();
  const auto buffer = device_.create_buffer(desc);
  if (!buffer.ok()) return buffer.error();
  Uploader uploader(device_);
  uploader.buffer(*buffer, std::move(bytes), gpu::Access::vertex_input);
  Status uploaded;
  try {
    uploaded = uploader.flush(executor);
  } catch (...) {
    device_.destroy(*buffer);
    throw;
  }
  device_.destroy(uploaded.ok() ? std::exchange(buffers_[3], *buffer) : *buffer);
  return uploaded;
}

}  // namespace gloam

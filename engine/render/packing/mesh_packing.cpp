// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/packing/mesh_packing.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <cmath>

#include "engine/math/packing.h"

namespace gloam {
namespace {

constexpr std::uint32_t kHandednessBit = 0x10000u;

std::uint32_t unorm(float value, float scale) {
  return static_cast<std::uint32_t>(std::lround(std::clamp(value, 0.0f, 1.0f) * scale));
}

/// Weights that sum to 1, none negative. If the sum is 0 or not finite, the first joint gets all the weight.
vec4 normalised(vec4 weights) {
  float sum = 0.0f;
  for (int k = 0; k < 4; ++k) {
    if (!(weights[k] > 0.0f)) weights[k] = 0.0f;  // NaN too
    sum += weights[k];
  }
  if (!(sum > 0.0f) || !std::isfinite(sum)) return {1.0f, 0.0f, 0.0f, 0.0f};
  return weights / sum;
}

/// Moves values[v] to index place[v]; drops it if place[v] is kNone.
template <class T>
std::vector<T> moved(const std::vector<T>& values, std::span<const std::uint32_t> place, std::size_t count) {
  if (values.empty()) return {};
  std::vector<T> result(count);
  for (std::size_t v = 0; v < std::min(values.size(), place.size()); ++v)
    if (place[v] != kNone) result[place[v]] = values[v];
  return result;
}

}  // namespace

std::vector<PackedFrame> pack_frames(const Primitive& primitive) {
  std::vector<PackedFrame> frames(primitive.positions.size());
  for (std::size_t i = 0; i < frames.size(); ++i) {
    frames[i].normal = pack_normal_snorm16(primitive.normals[i]);
    const vec4 tangent = primitive.tangents.empty() ? vec4(1.0f, 0.0f, 0.0f, 1.0f) : primitive.tangents[i];
    frames[i].tangent = pack_normal_snorm16(vec3(tangent)) & ~kHandednessBit;
    if (tangent.w < 0.0f) frames[i].tangent |= kHandednessBit;
  }
  return frames;
}

std::vector<PackedSurface> pack_surfaces(const Primitive& primitive) {
  std::vector<PackedSurface> surfaces(primitive.positions.size());
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    if (!primitive.uv0.empty()) surfaces[i].uv0 = primitive.uv0[i];
    if (!primitive.uv1.empty()) surfaces[i].uv1 = primitive.uv1[i];
    if (primitive.colors.empty()) continue;
    for (int channel = 0; channel < 4; ++channel)
      surfaces[i].color[static_cast<std::size_t>(channel)] =
          float_to_half(std::clamp(primitive.colors[i][channel], 0.0f, 1.0f));
  }
  return surfaces;
}

std::vector<PackedInfluence> pack_influences(const Primitive& primitive) {
  if (primitive.joints.empty() || primitive.weights.empty()) return {};
  std::vector<PackedInfluence> packed(primitive.positions.size());
  for (std::size_t i = 0; i < packed.size(); ++i) {
    const auto& joints = primitive.joints[i];
    const vec4 weights = normalised(primitive.weights[i]);
    std::uint32_t w[4];
    std::uint32_t sum = 0;
    int heaviest = 0;
    for (int k = 0; k < 4; ++k) {
      w[k] = unorm(weights[k], 65535.0f);
      sum += w[k];
      if (w[k] > w[heaviest]) heaviest = k;
    }
    // Rounding leaves the sum a few units off; the heaviest influence takes the difference.
    w[heaviest] = w[heaviest] + 65535u - sum;
    packed[i] = {joints[0] | static_cast<std::uint32_t>(joints[1]) << 16,
                 joints[2] | static_cast<std::uint32_t>(joints[3]) << 16, w[0] | w[1] << 16, w[2] | w[3] << 16};
  }
  return packed;
}

std::vector<float> pack_morph_offsets(const Primitive& primitive, bool& has_normals) {
  has_normals = !primitive.morph_targets.empty() &&
                std::all_of(primitive.morph_targets.begin(), primitive.morph_targets.end(),
                            [](const Primitive::MorphTarget& target) { return !target.normals.empty(); });
  std::vector<float> offsets;
  const auto append = [&](const std::vector<vec3>& plane) {
    for (std::size_t i = 0; i < primitive.positions.size(); ++i) {
      const vec3 offset = i < plane.size() ? plane[i] : vec3(0.0f);
      offsets.insert(offsets.end(), {offset.x, offset.y, offset.z});
    }
  };
  for (const Primitive::MorphTarget& target : primitive.morph_targets) {
    append(target.positions);
    if (has_normals) append(target.normals);
  }
  return offsets;
}

std::vector<Cluster> sort_into_clusters(std::span<const vec3> positions, std::vector<std::uint32_t>& indices) {
  if (indices.size() > 3 * kClusterTriangles) {
    std::vector<std::uint32_t> sorted(indices.size());
    meshopt_spatialSortTriangles(sorted.data(), indices.data(), indices.size(), &positions[0].x, positions.size(),
                                 sizeof(vec3));
    indices = std::move(sorted);
  }
  std::vector<Cluster> clusters;
  for (std::size_t first = 0; first < indices.size(); first += 3 * kClusterTriangles) {
    Cluster cluster;
    cluster.first_index = static_cast<std::uint32_t>(first);
    cluster.index_count = static_cast<std::uint32_t>(std::min(3 * kClusterTriangles, indices.size() - first));
    for (std::size_t i = 0; i < cluster.index_count; ++i) cluster.bounds.grow(positions[indices[first + i]]);
    clusters.push_back(cluster);
  }
  return clusters;
}

std::vector<Cluster> build_clusters(const Primitive& primitive, std::vector<std::uint32_t>& indices) {
  indices = primitive.indices;
  return sort_into_clusters(primitive.positions, indices);
}

std::vector<std::uint32_t> fetch_order(std::size_t vertex_count, std::span<std::uint32_t> indices,
                                       std::uint32_t& count) {
  std::vector<std::uint32_t> place(vertex_count, kNone);
  count = 0;
  for (std::uint32_t& index : indices) {
    std::uint32_t& at = place[index];
    if (at == kNone) at = count++;
    index = at;
  }
  return place;
}

Primitive in_fetch_order(const Primitive& primitive, std::span<std::uint32_t> indices) {
  std::uint32_t count = 0;
  const std::vector<std::uint32_t> place = fetch_order(primitive.positions.size(), indices, count);
  Primitive ordered;
  ordered.material = primitive.material;
  ordered.bounds = primitive.bounds;
  ordered.positions = moved(primitive.positions, place, count);
  ordered.normals = moved(primitive.normals, place, count);
  ordered.tangents = moved(primitive.tangents, place, count);
  ordered.uv0 = moved(primitive.uv0, place, count);
  ordered.uv1 = moved(primitive.uv1, place, count);
  ordered.colors = moved(primitive.colors, place, count);
  ordered.joints = moved(primitive.joints, place, count);
  ordered.weights = moved(primitive.weights, place, count);
  for (const Primitive::MorphTarget& target : primitive.morph_targets)
    ordered.morph_targets.push_back({moved(target.positions, place, count), moved(target.normals, place, count)});
  return ordered;
}

}  // namespace gloam

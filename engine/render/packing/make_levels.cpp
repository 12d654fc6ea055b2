// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/packing/make_levels.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <numeric>
#include <span>
#include <utility>

#include "engine/render/packing/merged_mesh.h"
#include "engine/render/packing/mesh_packing.h"
#include "engine/render/packing/nearest_surface.h"

namespace gloam {
namespace {

constexpr std::size_t kFewestLevelIndices = std::size_t{3} * 32;  ///< levels of fewer are not drawn faster
constexpr float kGreatestError = 0.25f;                           ///< of a level, as a share of the mesh's longest side

struct Influence {
  std::uint32_t joint = 0;
  float weight = 0.0f;
};

std::array<Influence, 4> influences_of(const PackedInfluence& packed) {
  const auto one = [](std::uint32_t joint, std::uint32_t weight) {
    return Influence{joint & 0xFFFFu, static_cast<float>(weight & 0xFFFFu) / 65535.0f};
  };
  return {one(packed.joints01, packed.weights01), one(packed.joints01 >> 16, packed.weights01 >> 16),
          one(packed.joints23, packed.weights23), one(packed.joints23 >> 16, packed.weights23 >> 16)};
}

/// Collects the differences between skinned vertices and the surface of levels (posed_errors()).
class SkinErrors {
 public:
  explicit SkinErrors(std::span<const PackedInfluence> influences) : influences_(influences) {}

  /// Notes that a level has the point with these corners and weights in place of a vertex.
  void add(std::size_t level, std::uint32_t vertex, float distance, std::span<const vec3> positions,
           const std::array<std::uint32_t, 3>& corners, const vec3& weights) {
    std::map<std::uint32_t, vec4> terms;  // q_j, by joint
    std::uint32_t reference = 0;
    float heaviest = -1.0f;
    for (const Influence& own : influences_of(influences_[vertex])) {
      terms[own.joint] += own.weight * vec4(positions[vertex], 1.0f);
      if (own.weight > heaviest) heaviest = own.weight, reference = own.joint;
    }
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t corner = corners[static_cast<std::size_t>(k)];
      for (const Influence& own : influences_of(influences_[corner]))
        terms[own.joint] -= weights[k] * own.weight * vec4(positions[corner], 1.0f);
    }
    std::vector<Note>& alone = notes_[{reference, reference}];
    alone.push_back({level, vec4(distance, 0.0f, 0.0f, 0.0f), vec3(0.0f)});
    for (const auto& [joint, term] : terms)
      if (joint != reference && term != vec4(0.0f))
        notes_[{reference, joint}].push_back({level, term, positions[vertex]});
  }

  void write(DetailLevels& made) const {
    for (const auto& [key, notes] : notes_) {
      JointPair pair{key.first, key.second, center_of(notes)};
      made.pairs.push_back(pair);
      for (DetailLevel& level : made.levels) level.pair_errors.emplace_back();
      for (const Note& note : notes) {
        PairError& error = made.levels[note.level].pair_errors.back();
        error.reach = std::max(error.reach, glm::length(vec3(note.term) - note.term.w * pair.center));
        error.weight = std::max(error.weight, std::abs(note.term.w));
      }
    }
  }

 private:
  struct Note {
    std::size_t level = 0;
    vec4 term = vec4(0.0f);
    vec3 position = vec3(0.0f);
  };
  /// The mean of the vertices, those with the greatest difference of weights counting the most.
  static vec3 center_of(std::span<const Note> notes) {
    vec3 sum(0.0f);
    float weights = 0.0f;
    for (const Note& note : notes) {
      sum += std::abs(note.term.w) * note.position;
      weights += std::abs(note.term.w);
    }
    return weights > 0.0f ? sum / weights : notes.front().position;
  }

  std::span<const PackedInfluence> influences_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<Note>> notes_;
};

/// Triangles of a coarser level; empty if there is none. Indices are those of the merged mesh.
std::vector<std::uint32_t> halved(const MergedMesh& mesh, std::span<const std::uint32_t> indices) {
  if (indices.size() < kFewestLevelIndices) return {};
  std::vector<std::uint32_t> fewer(indices.size());
  fewer.resize(meshopt_simplify(fewer.data(), indices.data(), indices.size(), &mesh.positions[0].x,
                                mesh.positions.size(), sizeof(vec3), indices.size() / 6 * 3, kGreatestError,
                                meshopt_SimplifyLockBorder, nullptr));
  if (fewer.size() > indices.size() / 5 * 4) fewer.clear();
  return fewer;
}

/// How far attributes of a vertex are displaced where a triangle with these corners is drawn in its place. A change of
/// texture coordinates is a distance on the surface. A change of normal or colour counts with the distance to the
/// nearest corner: as far as a gradient would have to move that explains it.
float displacement(const Primitive& mesh, std::uint32_t vertex, const std::array<std::uint32_t, 3>& corners,
                   const vec3& weights) {
  const auto mixed = [&](const auto& values) {
    return values[corners[0]] * weights.x + values[corners[1]] * weights.y + values[corners[2]] * weights.z;
  };
  float reach = std::numeric_limits<float>::infinity();
  for (const std::uint32_t corner : corners)
    reach = std::min(reach, glm::length(mesh.positions[vertex] - mesh.positions[corner]));
  const vec3 normal = mixed(mesh.normals);
  const float length = glm::length(normal);
  float change = length > 0.0f ? glm::length(normal / length - mesh.normals[vertex]) : 2.0f;
  if (!mesh.colors.empty()) change = std::max(change, glm::length(mixed(mesh.colors) - mesh.colors[vertex]));
  float most = change * reach;
  for (const std::vector<vec2>* uvs : {&mesh.uv0, &mesh.uv1}) {
    if (uvs->empty()) continue;
    float scale = 0.0f;  // metres for each unit of texture coordinates
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t from = corners[k], to = corners[(k + 1) % 3];
      const float across = glm::length((*uvs)[to] - (*uvs)[from]);
      if (across > 0.0f) scale = std::max(scale, glm::length(mesh.positions[to] - mesh.positions[from]) / across);
    }
    most = std::max(most, scale * glm::length(mixed(*uvs) - (*uvs)[vertex]));
  }
  return most;
}

/// For each vertex, a point near it inside its own triangles. At a seam, what is nearest to it is on the same side.
std::vector<vec3> points_beside_seams(std::span<const vec3> positions, std::span<const std::uint32_t> indices) {
  constexpr float kShare = 1e-3f;  // of the way to the middle of the triangles
  std::vector<vec4> sums(positions.size(), vec4(0.0f));
  for (std::size_t i = 0; i < indices.size(); i += 3) {
    const vec3 sum = positions[indices[i]] + positions[indices[i + 1]] + positions[indices[i + 2]];
    for (std::size_t k = 0; k < 3; ++k) sums[indices[i + k]] += vec4(sum / 3.0f, 1.0f);
  }
  std::vector<vec3> points(positions.begin(), positions.end());
  for (std::size_t v = 0; v < points.size(); ++v)
    if (sums[v].w > 0.0f) points[v] += kShare * (vec3(sums[v]) / sums[v].w - points[v]);
  return points;
}

/// The error of a level of `ordered`, and for a skinned one the differences by joint. points: of the vertices, where
/// the level is searched for its nearest point.
float measure(const Primitive& ordered, std::span<const vec3> points, std::span<const std::uint32_t> level,
              LevelUse use, std::size_t number, SkinErrors* skin) {
  const std::vector<vec3>& positions = ordered.positions;
  std::vector<bool> kept(positions.size(), false);
  for (const std::uint32_t index : level) kept[index] = true;
  const NearestSurface surface(positions, level);
  float greatest = 0.0f;
  for (std::uint32_t v = 0; v < positions.size(); ++v) {
    if (kept[v]) continue;
    const NearestSurface::Hit hit = surface.nearest(points[v]);
    const std::array<std::uint32_t, 3> corners = {level[hit.first_index], level[hit.first_index + 1],
                                                  level[hit.first_index + 2]};
    float error = hit.distance + glm::length(points[v] - positions[v]);
    if (use == LevelUse::views) error = std::max(error, displacement(ordered, v, corners, hit.weights));
    greatest = std::max(greatest, error);
    if (skin != nullptr) skin->add(number, v, error, positions, corners, hit.weights);
  }
  return greatest;
}

/// The triangles as the simplifier reads them. `ordered` has used vertices only.
MergedMesh simplifier_mesh(const Primitive& ordered, const std::vector<std::uint32_t>& indices, LevelUse use) {
  if (use == LevelUse::maps) return merged_by_position(ordered.positions, indices);
  MergedMesh mesh{ordered.positions, indices, std::vector<std::uint32_t>(ordered.positions.size())};
  std::iota(mesh.original.begin(), mesh.original.end(), 0u);
  return mesh;
}

}  // namespace

MadeLevels make_levels(const Primitive& source, LevelUse use) {
  MadeLevels made;
  if (!source.morph_targets.empty() || source.indices.size() < kFewestLevelIndices) return made;
  std::vector<std::uint32_t> indices;
  static_cast<void>(build_clusters(source, indices));
  const Primitive ordered = in_fetch_order(source, indices);
  const std::vector<PackedInfluence> influences = pack_influences(ordered);
  const MergedMesh mesh = simplifier_mesh(ordered, indices, use);
  const std::vector<vec3> points =
      use == LevelUse::views ? points_beside_seams(ordered.positions, indices) : ordered.positions;
  SkinErrors skin(influences);
  float error = 0.0f;
  std::vector<std::uint32_t> level = mesh.indices;
  while (made.levels.levels.size() < kMostDetailLevels) {
    level = halved(mesh, level);
    if (level.empty()) break;
    std::vector<std::uint32_t> own(level.size());
    for (std::size_t i = 0; i < level.size(); ++i) own[i] = mesh.original[level[i]];
    DetailLevel& added = made.levels.levels.emplace_back();
    added.clusters = sort_into_clusters(ordered.positions, own);
    error = std::max(
        error, measure(ordered, points, own, use, made.levels.levels.size() - 1, influences.empty() ? nullptr : &skin));
    added.error = error;
    added.first_index = static_cast<std::uint32_t>(made.indices.size());
    added.index_count = static_cast<std::uint32_t>(own.size());
    made.indices.insert(made.indices.end(), own.begin(), own.end());
  }
  made.levels.index_count = static_cast<std::uint32_t>(made.indices.size());
  if (!made.levels.levels.empty() && !influences.empty()) skin.write(made.levels);
  return made;
}

}  // namespace gloam

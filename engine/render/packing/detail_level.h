// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/math/types.h"
#include "engine/render/packing/mesh_packing.h"

namespace gloam {

/// Most levels of detail of a primitive, the full triangles not counted.
inline constexpr std::size_t kMostDetailLevels = 8;

/// Two joints that move the same vertices. `reference` moves a vertex the most; equal joints stand for that one alone.
struct JointPair {
  std::uint32_t reference = 0;
  std::uint32_t joint = 0;
  vec3 center = vec3(0.0f);  ///< of those vertices, in the rest pose
};

/// What levels of detail are drawn in.
enum class LevelUse : std::uint8_t {
  maps,   ///< shadow maps: only the place of the surface counts
  views,  ///< pictures: attributes count, too
};
inline constexpr std::size_t kLevelUses = 2;

/// How far a level departs from the full surface by one JointPair (posed_errors()).
struct PairError {
  float reach = 0.0f;   ///< mesh units
  float weight = 0.0f;  ///< difference of weights
};

/// Fewer triangles of a primitive's vertices.
struct DetailLevel {
  std::uint32_t first_index = 0;  ///< relative to DetailLevels::first_index
  std::uint32_t index_count = 0;
  /// In the rest pose: the greatest distance of the full mesh's vertices from the level. LevelUse::views: or the
  /// greatest distance by which an attribute is displaced, if that is more.
  float error = 0.0f;
  std::vector<Cluster> clusters;       ///< relative to the level's first index
  std::vector<PairError> pair_errors;  ///< by item of DetailLevels::pairs
};

/// The levels of detail of a primitive, from fine to coarse; their errors never fall.
struct DetailLevels {
  bool tried = false;  ///< they were made, if they could be
  std::uint32_t first_index = 0;
  std::uint32_t index_count = 0;  ///< of all levels together
  std::vector<DetailLevel> levels;
  std::vector<JointPair> pairs;  ///< of a skinned primitive, those with the same reference one after another
};

/// A length for each level.
using LevelErrors = std::array<float, kMostDetailLevels>;

/// By LevelUse.
using LevelsByUse = std::array<DetailLevels, kLevelUses>;

/// A bound on the factor by which a matrix lengthens vectors; exact for a rotation with a uniform scale.
[[nodiscard]] double greatest_scale(const glm::dmat3& matrix);

/// For each level, a bound on the distance of the full mesh's skinned vertices from the level's skinned surface.
/// Infinite if a joint is missing or not finite. joints: the matrices of the instance. errors: one for each level.
void posed_errors(const DetailLevels& levels, std::span<const mat4> joints, std::span<float> errors);

}  // namespace gloam

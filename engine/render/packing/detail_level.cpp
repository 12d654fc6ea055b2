// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/packing/detail_level.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gloam {
namespace {

/// How a pose weighs the two parts of a PairError.
PairError pose_of(const JointPair& pair, std::span<const mat4> joints) {
  const mat4& reference = joints[pair.reference];
  const auto scale = [](const mat4& matrix) { return static_cast<float>(greatest_scale(glm::dmat3(matrix))); };
  if (pair.joint == pair.reference) return {scale(reference), 0.0f};
  const mat4 difference = joints[pair.joint] - reference;
  return {scale(difference), glm::length(vec3(difference * vec4(pair.center, 1.0f)))};
}

}  // namespace

double greatest_scale(const glm::dmat3& matrix) {
  // The square root of a norm of Mᵀ M.
  const glm::dmat3 square = glm::transpose(matrix) * matrix;
  double greatest = 0.0;
  for (int column = 0; column < 3; ++column) {
    const dvec3 sizes = glm::abs(square[column]);
    greatest = std::max(greatest, sizes.x + sizes.y + sizes.z);
  }
  return std::sqrt(greatest);
}

// A skinned vertex is Σ w_j M_j v. Its nearest point p of the level, Σ b_k v_k, goes to Σ b_k Σ w_kj M_j v_k. With the
// reference joint r and D_j = M_j − M_r, the difference of both is L_r (v − p) + Σ_j D_j q_j, where L_r is the linear
// part of M_r and q_j = w_j (v, 1) − Σ b_k w_kj (v_k, 1) depends on the rest pose only. With the centre c of a pair,
// |D_j q_j| ≤ ‖D_j‖ |q_j.xyz − q_j.w c| + |q_j.w| |D_j c|. PairError holds the greatest of both factors over all
// vertices. Near a joint D_j c is small, so the bound is close to the distance in the rest pose.
void posed_errors(const DetailLevels& levels, std::span<const mat4> joints, std::span<float> errors) {
  constexpr float kUnknown = std::numeric_limits<float>::infinity();
  std::vector<float> sums(levels.levels.size(), 0.0f);
  std::ranges::fill(errors, 0.0f);
  const auto end_group = [&] {
    for (std::size_t l = 0; l < sums.size(); ++l) {
      errors[l] = std::isfinite(sums[l]) ? std::max(errors[l], sums[l]) : kUnknown;
      sums[l] = 0.0f;
    }
  };
  for (std::size_t i = 0; i < levels.pairs.size(); ++i) {
    const JointPair& pair = levels.pairs[i];
    if (std::max(pair.reference, pair.joint) >= joints.size()) {
      std::ranges::fill(errors, kUnknown);
      return;
    }
    const PairError pose = pose_of(pair, joints);
    for (std::size_t l = 0; l < sums.size(); ++l) {
      const PairError& own = levels.levels[l].pair_errors[i];
      sums[l] += pose.reach * own.reach + pose.weight * own.weight;
    }
    if (i + 1 == levels.pairs.size() || levels.pairs[i + 1].reference != pair.reference) end_group();
  }
  for (std::size_t l = 1; l < errors.size(); ++l) errors[l] = std::max(errors[l], errors[l - 1]);
}

}  // namespace gloam

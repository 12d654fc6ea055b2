// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/draws/occluders.h"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <utility>

namespace gloam {
namespace {

struct Candidate {
  float worth = 0.0f;         ///< share of the picture for each triangle
  std::uint32_t draw = 0;     ///< index into ViewDraws::solid
  std::uint32_t cluster = 0;  ///< index into ViewDraws::clusters
};

/// Share of the picture that the cluster's box covers; 1 if it reaches behind the camera.
float covered_share(const RenderView& view, const shaders::DrawCluster& cluster) {
  vec2 low(1.0f), high(-1.0f);
  for (int corner = 0; corner < 8; ++corner) {
    const vec3 point((corner & 1) != 0 ? cluster.high.x : cluster.low.x,
                     (corner & 2) != 0 ? cluster.high.y : cluster.low.y,
                     (corner & 4) != 0 ? cluster.high.z : cluster.low.z);
    const vec4 clip = view.clip_from_relative * vec4(point, 1.0f);
    if (!(clip.w > 0.0f)) return 1.0f;
    const vec2 at = glm::clamp(vec2(clip) / clip.w, -1.0f, 1.0f);
    low = glm::min(low, at);
    high = glm::max(high, at);
  }
  const vec2 size = glm::max(high - low, vec2(0.0f));
  return 0.25f * size.x * size.y;
}

std::vector<Candidate> candidates(const RenderView& view, const ViewDraws& draws) {
  std::vector<Candidate> found;
  for (std::uint32_t d = 0; d < draws.solid.size(); ++d) {
    const Draw& draw = draws.solid[d];
    if ((draw.variant.features & GLOAM_SURFACE_MASK) != 0 || draw.bounds.empty()) continue;
    for (std::uint32_t c = draw.first_cluster; c < draw.first_cluster + draw.cluster_count; ++c) {
      const shaders::DrawCluster& cluster = draws.clusters[c];
      const float triangles = static_cast<float>(std::max(cluster.index_count / 3, 1u));
      found.push_back({covered_share(view, cluster) / triangles, d, c});
    }
  }
  return found;
}

}  // namespace

std::uint32_t solid_triangles(const ViewDraws& draws) {
  std::uint32_t triangles = 0;
  for (const Draw& draw : draws.solid) triangles += draw.index_count / 3;
  return triangles;
}

std::vector<Draw> choose_occluders(const RenderView& view, const ViewDraws& draws, std::uint32_t most_triangles) {
  std::vector<Candidate> best = candidates(view, draws);
  std::ranges::stable_sort(best, std::ranges::greater{}, &Candidate::worth);
  std::size_t count = 0;
  for (std::uint32_t triangles = 0; count < best.size() && best[count].worth > 0.0f; ++count) {
    triangles += draws.clusters[best[count].cluster].index_count / 3;
    if (triangles > most_triangles) break;
  }
  best.resize(count);
  std::ranges::sort(best, {}, [](const Candidate& one) { return std::pair(one.draw, one.cluster); });
  std::vector<Draw> occluders;
  for (const Candidate& one : best) {
    const shaders::DrawCluster& cluster = draws.clusters[one.cluster];
    const bool joins = !occluders.empty() && occluders.back().entity == draws.solid[one.draw].entity &&
                       occluders.back().first_index + occluders.back().index_count == cluster.first_index;
    if (!joins) {
      occluders.push_back(draws.solid[one.draw]);
      occluders.back().first_index = cluster.first_index;
      occluders.back().index_count = 0;
      // Only what decides where triangles are drawn.
      occluders.back().variant = {0, draws.solid[one.draw].variant.cull};
    }
    occluders.back().index_count += cluster.index_count;
  }
  return occluders;
}

}  // namespace gloam

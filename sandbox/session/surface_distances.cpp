// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/session/surface_distances.h"

#include <limits>
#include <vector>

namespace gloam {

SurfaceDistances surface_distances(const SceneTracer& tracer, const SceneAssets& assets, JobExecutor& executor) {
  return [&](std::span<const dvec3> origins, std::span<const dvec3> directions, std::span<double> hits_m) {
    executor.parallel_for(origins.size(), 1024, [&](JobRange range) {
      std::vector<SurfaceRay> rays;
      for (std::size_t i = range.begin; i < range.end; ++i)
        rays.push_back({.origin = vec3(origins[i] - tracer.origin()), .direction = vec3(directions[i])});
      std::vector<TracedSurface> surfaces(rays.size());
      tracer.nearest(assets, rays, surfaces);
      for (std::size_t i = 0; i < surfaces.size(); ++i)
        hits_m[range.begin + i] =
            surfaces[i].hit ? static_cast<double>(surfaces[i].distance_m) : std::numeric_limits<double>::infinity();
    });
  };
}

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/diffuse/capture.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/scene/resources.h"
#include "modules/lighting/outputs.h"
#include "modules/reflections/bake/cube.h"
#include "modules/reflections/bake/probe_map.h"
#include "modules/reflections/diffuse/harmonics.h"
#include "modules/reflections/diffuse/neighbourhood.h"
#include "modules/reflections/relighting/light_states.h"

namespace gloam {
namespace {

// Pixels of a face's sides. Harmonics of order 2 are as smooth as 45°, but a lamp's bright surroundings are small.
constexpr std::uint32_t kFaceSide = 64;

class SurroundingsScope {
 public:
  explicit SurroundingsScope(World& world) : world_(world) { world.set_resource(SurroundingsLeftOut{}); }
  ~SurroundingsScope() { world_.remove_resource<SurroundingsLeftOut>(); }
  SurroundingsScope(const SurroundingsScope&) = delete;
  SurroundingsScope& operator=(const SurroundingsScope&) = delete;

 private:
  World& world_;
};

/// Radiance in the cells of a probe's map, cd/m².
std::vector<vec3> cell_radiance(const std::array<CapturedPicture, 6>& faces, float light_scale, JobExecutor& executor) {
  const CapturedCube cube(faces, executor);
  const float lod = std::log2(static_cast<float>(kFaceSide) * 2.0f / static_cast<float>(kProbeCells));
  std::vector<vec3> radiance;
  for (std::uint32_t y = 0; y < kProbeCells; ++y)
    for (std::uint32_t x = 0; x < kProbeCells; ++x) {
      const vec2 uv = (vec2(static_cast<float>(x), static_cast<float>(y)) + 0.5f) / static_cast<float>(kProbeCells);
      radiance.push_back(cube.sample(probe_map_direction(uv), lod) / light_scale);
    }
  return radiance;
}

vec3 mean_sky(const SceneEnvironment& sky) { return 0.5f * (sky.sky_horizon + sky.sky_zenith); }

}  // namespace

Result<ProbeDiffuse> capture_diffuse(Renderer& renderer, World& world, const dvec3& eye, float light_scale,
                                     std::span<const CapturedSurface> surfaces, JobExecutor& executor) {
  const SurroundingsScope scope(world);
  const auto all = draw_cube_faces(renderer, world, eye, kFaceSide, light_scale, CapturedLamps::on);
  if (!all.ok()) return all.error();
  auto unlit = draw_cube_faces(renderer, world, eye, kFaceSide, light_scale, CapturedLamps::left_out);
  if (!unlit.ok()) return unlit.error();
  std::array<CapturedPicture, 6> lamps = *all;
  for (std::size_t face = 0; face < lamps.size(); ++face)
    for (std::size_t i = 0; i < lamps[face].texels.size(); ++i)
      lamps[face].texels[i] = glm::max(lamps[face].texels[i] - (*unlit)[face].texels[i], vec4(0.0f));
  ProbeDiffuse diffuse;
  const auto keep = [&](const std::array<CapturedPicture, 6>& faces, std::array<vec3, kDiffuseTerms>& terms) {
    std::ranges::transform(diffuse_terms(project_cube(faces)), terms.begin(),
                           [&](const dvec3& term) { return vec3(term / static_cast<double>(light_scale)); });
  };
  keep(lamps, diffuse.lamps);
  keep(*unlit, diffuse.unlit);
  if (surfaces.empty()) return diffuse;
  const auto& sky = world.resource<SceneEnvironment>();
  const ProbeNeighbourhood seen =
      probe_neighbourhood(surfaces, cell_radiance(*unlit, light_scale, executor), mean_sky(sky));
  diffuse.reach = seen.reach;
  diffuse.open = seen.open;
  return diffuse;
}

}  // namespace gloam

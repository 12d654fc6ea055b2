// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/diffuse/capture.h"

#include <algorithm>

#include "modules/lighting/outputs.h"
#include "modules/reflections/bake/cube.h"
#include "modules/reflections/diffuse/harmonics.h"

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

}  // namespace

Result<ProbeDiffuse> capture_diffuse(Renderer& renderer, World& world, const dvec3& eye, float light_scale) {
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
  return diffuse;
}

}  // namespace gloam

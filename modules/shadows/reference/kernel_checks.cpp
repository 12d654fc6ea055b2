// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/reference/kernel_checks.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "engine/core/text/formatted.h"
#include "modules/shadows/reference/filter_run.h"
#include "modules/shadows/reference/planes_run.h"

namespace gloam {
namespace {

/// The greatest height of a depth over its plane, and difference of a plane from the twin's, as multiples of the
/// rounding that floats allow.
void add_plane_errors(const PlaneFace& face, const MadePlanes& made, KernelError& error) {
  const auto expected = expected_planes(face);
  for_blocks(face, [&](std::uint32_t level, uvec2 block) {
    const dvec4 plane = made.plane(face, level, block);
    const dvec4 twin = expected[level][block.y * face.blocks(level) + block.x];
    const std::string words = formatted("level %u of a face of %u texels", level, face.size);
    const auto add = [&](double difference, double rounding) {
      error.add(difference <= 0.0 ? 0.0 : difference / rounding, words);
    };
    const dvec4 difference = abs(plane - twin);
    add(difference.x, height_rounding(twin.w, level));
    add(std::max(difference.y, difference.z), slope_rounding(twin.w));
    add(difference.w, slope_rounding(twin.w));
    const std::uint32_t side = kPlaneBlock << level;
    double above = 0.0;
    for_square(side, [&](uvec2 texel) {
      const double depth = face.depth(block * side + texel);
      // A slanted plane of a coarser level may fall below 0 where texels are empty.
      if (level == 0 || depth > 0.0) above = std::max(above, depth - plane_depth(plane, from_middle(texel, side)));
    });
    add(above, plane_rounding(plane.w, level));
  });
}

Result<KernelError> run_planes(KernelLab& lab) {
  std::mt19937 random(5);
  KernelError error;
  for (int i = 0; i < 2; ++i) {
    const std::vector<PlaneFace> faces = random_faces(random);
    PlaneRun run(lab);
    GLOAM_TRY(run.start(kPlaneAtlas));
    GLOAM_TRY(run.draw(faces));
    GLOAM_TRY(run.make(faces));
    const auto made = run.read();
    if (!made) return made.error();
    for (const PlaneFace& face : faces) add_plane_errors(face, *made, error);
  }
  return error;
}

/// The differences of all pixels in the light's cone, over the number of those in a penumbra.
Result<KernelError> run_filter_cases(KernelLab& lab) {
  KernelError error;
  for (const double width_m : {0.2, 0.3, 0.5}) {
    FilterScene scene{.width_m = width_m};
    scene.plates = {{2.0, uvec2(60, 70), uvec2(130, 110)}, {3.0, uvec2(150, 40), uvec2(190, 200)}};
    const auto found = run_filter(lab, scene);
    if (!found) return found.error();
    double sum = 0.0, in_penumbra = 0.0;
    for_square(FilterScene::kPictureSide, [&](uvec2 pixel) {
      if (!FilterScene::in_cone(pixel)) return;
      const double seen = scene.seen_share(pixel);
      sum += std::abs((*found)[std::size_t{pixel.y} * FilterScene::kPictureSide + pixel.x] - seen);
      in_penumbra += seen > 0.0 && seen < 1.0 ? 1.0 : 0.0;
    });
    error.add(sum / in_penumbra, formatted("a light of %g m", width_m));
  }
  return error;
}

}  // namespace

std::vector<KernelCheck> shadow_kernel_checks() {
  return {
      {.name = "kernel.shadow_filter",
       .sentence = "light that a shadow map's filter lets through against all texels of the map in double precision",
       .unit = "of the light",
       // The specification asks for a mean error of 0.02 in penumbrae. In these a texel of the map is a tenth of the
       // penumbra or less.
       .bound = 0.04,
       .advice = "Try shadows.filter=pcf, and report the device",
       .quick = true,
       .run = &run_filter_cases},
      {.name = "kernel.planes",
       .sentence = "planes over blocks of a shadow map against those of all texels in double precision",
       .unit = "of the rounding",
       // If all roundings of a sum of 64 depths added up it would be 1; they cancel for the most part.
       .bound = 0.15,
       .advice = "Set shadows.classify=off, which does not read the planes, and report the device",
       .quick = true,
       .run = &run_planes}};
}

}  // namespace gloam

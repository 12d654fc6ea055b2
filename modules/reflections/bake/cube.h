// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/core/result.h"
#include "engine/ecs/world.h"
#include "engine/jobs/executor.h"
#include "engine/math/types.h"
#include "engine/render/renderer.h"
#include "modules/reflections/bake/picture.h"
#include "modules/reflections/captures.h"

namespace gloam {

/// A face of a cube as its camera sees it. Faces are numbered +X, −X, +Y, −Y, +Z, −Z.
struct CubeFaceAxes {
  dvec3 forward;
  dvec3 right;
  dvec3 up;
};
[[nodiscard]] CubeFaceAxes cube_face_axes(std::uint32_t face);

/// The light that arrives at a point, as a cube with box-filtered mips down to 1 texel a face. Texels are weighted by
/// their solid angle.
class CapturedCube {
 public:
  /// faces: squares of one side, a power of two, as cube_face_axes() orders and orients them. Values must be finite.
  CapturedCube(const std::array<CapturedPicture, 6>& faces, JobExecutor& executor);

  [[nodiscard]] std::uint32_t side() const { return side_; }
  /// Radiance from a direction of any length > 0, interpolated within and across faces and between mips. lod: 0 is the
  /// full resolution.
  [[nodiscard]] vec3 sample(const vec3& direction, float lod) const;

 private:
  /// A mip of all faces. Each face has a border of 1 texel from its neighbours.
  struct Level {
    std::uint32_t side = 0;
    std::vector<vec3> texels;  ///< 6 · (side + 2)²
    [[nodiscard]] std::size_t at(std::uint32_t face, std::uint32_t x, std::uint32_t y) const {
      return (std::size_t{face} * (side + 2) + y) * (side + 2) + x;
    }
  };
  static void fill_borders(Level& level);
  [[nodiscard]] static Level halved(const Level& fine, JobExecutor& executor);
  [[nodiscard]] static vec3 sample(const Level& level, std::uint32_t face, vec2 position);

  std::uint32_t side_ = 0;
  std::vector<Level> levels_;
};

/// The view of one face of a cube around `eye`. side: pixels. unit_m: scene_unit().
[[nodiscard]] ViewSettings face_view(std::uint32_t face, const dvec3& eye, std::uint32_t side, double unit_m);

enum class CapturedLamps : std::uint8_t { on, left_out };

/// Draws the static scene around `eye`. side: pixels of a face's sides, a power of two. light_scale: of the captures.
/// With SurroundingsLeftOut in the world, surfaces reflect no surroundings either.
[[nodiscard]] Result<std::array<CapturedPicture, 6>> draw_cube_faces(Renderer& renderer, World& world, const dvec3& eye,
                                                                     std::uint32_t side, float light_scale,
                                                                     CapturedLamps lamps);

/// The surfaces of the static scene around `eye`: CapturedParts::surfaces.
[[nodiscard]] Result<std::vector<CapturedSurface>> probe_surfaces(Renderer& renderer, World& world, const dvec3& eye);

}  // namespace gloam

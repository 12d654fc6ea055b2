// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <random>
#include <span>
#include <vector>

#include "engine/render/view.h"
#include "shaders/shadows/final_lists_shared.h"
#include "tests/modules/shadows/support/maps.h"

namespace gloam::test {

enum class CastKind { spot, cube, sun };

/// A face of a light and its depths, row by row.
struct ClassifyFace {
  FacePose pose;
  uvec2 origin = uvec2(0);  ///< corner in the atlas
  std::vector<float> depths;
};

struct ClassifyLight {
  CastKind kind = CastKind::spot;
  dvec3 vector = dvec3(0.0);  ///< position, or the direction in which a sun shines
  double width = 0.0;         ///< diameter of the emitter; of a sun: penumbra width per metre
  double tan_inner = 1.0;     ///< without the rim; local lights
  double rim = 0.0;           ///< texels; suns
  std::vector<ClassifyFace> faces;
};

/// A pixel of a tile with a surface.
struct ClassifyPixel {
  uvec2 at = uvec2(0);  ///< in the tile
  float depth = 0.0f;   ///< of the camera
  dvec3 position = dvec3(0.0);
  dvec3 face_normal = dvec3(0.0);
  dvec3 shading_normal = dvec3(0.0);
  bool subsurface = false;
};

/// The pixels of a tile, in one or two groups.
struct ClassifyTile {
  std::array<std::vector<ClassifyPixel>, 2> groups;
  [[nodiscard]] bool has_two() const { return !groups[1].empty(); }
};

/// Images of the maps that the shaders of classification read.
struct ClassifyImages {
  std::vector<float> atlas;
  std::vector<float> pyramid;
  std::vector<vec4> planes;
};

/// Lights, their maps, and tiles that a camera in the origin sees.
struct ClassifyScene {
  RenderView view;
  std::uint32_t face_size = 64;
  std::uint32_t atlas_size = 512;
  std::array<ClassifyLight, 3> lights;  ///< a spot, a cube and a sun
  std::vector<ClassifyTile> tiles;

  [[nodiscard]] uvec2 grid() const { return {view.width / 8, view.height / 8}; }
};

/// The point in front of the camera that all lights illuminate.
inline constexpr dvec3 kClassifyMiddle = dvec3(0.0, 0.0, -4.0);

/// A scene with a camera and tiles without pixels, and without lights.
[[nodiscard]] ClassifyScene empty_classify_scene(std::uint32_t face_size);

/// Which part of a cube a direction falls on.
enum class CubePart { face_middle, edge, corner };
/// A random direction, in the world, near the middle of this part.
[[nodiscard]] dvec3 direction_to(CubePart part, std::mt19937& random);

[[nodiscard]] ClassifyLight classify_spot(const dvec3& position, const dvec3& forward, double tan_half, double width);
[[nodiscard]] ClassifyLight classify_cube(const dvec3& position, double width);
/// A sun with two cascades around a point.
[[nodiscard]] ClassifyLight classify_sun(const dvec3& direction, const dvec3& around, const glm::dvec2& half_extents_m,
                                         double penumbra_m_per_m, std::uint32_t face_size);

/// A rectangle; its sides run along two directions at right angles to the normal.
[[nodiscard]] RayScene rectangle(const dvec3& middle, const dvec3& normal, const glm::dvec2& half_size);

/// Places the faces in the atlas and draws them.
void draw_classify_maps(ClassifyScene& scene, const RayScene& casters);

/// The images of the scene's maps. The pyramid and the planes are computed from all texels of each block.
[[nodiscard]] ClassifyImages classify_images(const ClassifyScene& scene);

/// Rows of the spot (0) and of the cube (1).
[[nodiscard]] std::vector<shaders::ShadowRow> classify_rows(const ClassifyScene& scene);
/// Adds the scene's sun to the constants.
void set_classify_sun(const ClassifyScene& scene, shaders::ShadowBlock& block);

/// The surface of a plane under a pixel of a tile. None: the ray misses the plane, or nearly does.
[[nodiscard]] std::optional<ClassifyPixel> pixel_on_plane(const RenderView& view, uvec2 tile, uvec2 at,
                                                          const dvec3& point, const dvec3& normal);
/// The bounds of a group of pixels.
[[nodiscard]] shaders::ShadowTileGroup classify_group(std::span<const ClassifyPixel> pixels);

[[nodiscard]] inline double between(std::mt19937& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}
[[nodiscard]] dvec3 random_unit(std::mt19937& random);

}  // namespace gloam::test

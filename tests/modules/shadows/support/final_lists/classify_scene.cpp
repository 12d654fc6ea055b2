// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "tests/modules/shadows/support/final_lists/classify_scene.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "engine/math/packing.h"
#include "engine/render/camera/view_constants.h"
#include "modules/shadows/atlas/mip_places.h"
#include "shaders/shadows/maps/planes_shared.h"

namespace gloam::test {
namespace {

constexpr std::uint32_t kPlaneBlock = GLOAM_SHADOW_PLANE_BLOCK, kPyramidBlock = 1u << GLOAM_SHADOW_PYRAMID_MIP;

/// The place of a face: the four places of the upper left quarter of the atlas, then those of the upper right and of
/// the lower left quarter.
uvec2 place_of_face(std::uint32_t index, std::uint32_t size, std::uint32_t atlas_size) {
  const std::uint32_t quarter = index / 4, in_quarter = index % 4;
  return uvec2(quarter % 2, quarter / 2) * (atlas_size / 2) + uvec2(in_quarter % 2, in_quarter / 2) * size;
}

/// The texels of a block of a face.
struct Block {
  const ClassifyFace& face;
  std::uint32_t face_size;
  uvec2 first;
  std::uint32_t side;

  /// Calls visit(column, row, depth).
  template <class Visit>
  void each(Visit&& visit) const {
    for (std::uint32_t y = first.y; y < first.y + side; ++y)
      for (std::uint32_t x = first.x; x < first.x + side; ++x) visit(x, y, face.depths[y * face_size + x]);
  }
};

/// Calls visit(block, texel of the image) for the blocks of a level whose blocks of level 0 are `smallest` texels wide.
template <class Visit>
void each_block(const ClassifyScene& scene, const ClassifyFace& face, std::uint32_t smallest, std::uint32_t level,
                Visit&& visit) {
  const std::uint32_t side = smallest << level, size = scene.atlas_size / smallest;
  const uvec2 corner = mip_corner(size, level) + face.origin / side;
  const std::uint32_t count = scene.face_size / side;
  for (std::uint32_t y = 0; y < count; ++y)
    for (std::uint32_t x = 0; x < count; ++x)
      visit(Block{face, scene.face_size, uvec2(x, y) * side, side}, corner + uvec2(x, y));
}

void make_pyramid(const ClassifyScene& scene, const ClassifyFace& face, std::vector<float>& pyramid) {
  const uvec2 size = size_with_mips(scene.atlas_size / kPyramidBlock);
  for (std::uint32_t level = 0; kPyramidBlock << level <= scene.face_size; ++level)
    each_block(scene, face, kPyramidBlock, level, [&](const Block& block, uvec2 at) {
      float nearest = 0.0f, farthest = 1.0f;
      block.each([&](std::uint32_t, std::uint32_t, float depth) {
        nearest = std::max(nearest, depth);
        farthest = std::min(farthest, depth);
      });
      pyramid[at.y * size.x + at.x] = nearest;
      pyramid[(at.y + size.y) * size.x + at.x] = farthest;
    });
}

/// The plane of a block: slopes by least squares if the block is full, else 0; raised above all of its depths.
vec4 plane_above(const Block& block) {
  const double middle_x = block.first.x + 0.5 * block.side - 0.5, middle_y = block.first.y + 0.5 * block.side - 0.5;
  double moment_x = 0.0, moment_y = 0.0, squares = 0.0;
  float nearest = 0.0f, farthest = 1.0f;
  block.each([&](std::uint32_t x, std::uint32_t y, float depth) {
    moment_x += (x - middle_x) * static_cast<double>(depth);
    moment_y += (y - middle_y) * static_cast<double>(depth);
    squares += (x - middle_x) * (x - middle_x);
    nearest = std::max(nearest, depth);
    farthest = std::min(farthest, depth);
  });
  if (nearest == 0.0f) return vec4(0.0f);
  const vec2 slope = farthest > 0.0f ? vec2(glm::dvec2(moment_x, moment_y) / squares) : vec2(0.0f);
  double height = -1e30;
  block.each([&](std::uint32_t x, std::uint32_t y, float depth) {
    if (depth > 0.0f)
      height = std::max(height, static_cast<double>(depth) - static_cast<double>(slope.x) * (x - middle_x) -
                                    static_cast<double>(slope.y) * (y - middle_y));
  });
  return {std::nextafter(static_cast<float>(height), 2.0f), slope, nearest};
}

void make_planes(const ClassifyScene& scene, const ClassifyFace& face, std::vector<vec4>& planes) {
  const std::uint32_t width = size_with_mips(scene.atlas_size / kPlaneBlock).x;
  for (std::uint32_t level = 0; level < GLOAM_SHADOW_PLANE_LEVELS && kPlaneBlock << level <= scene.face_size; ++level)
    each_block(scene, face, kPlaneBlock, level,
               [&](const Block& block, uvec2 at) { planes[at.y * width + at.x] = plane_above(block); });
}

std::size_t area(uvec2 size) { return std::size_t{size.x} * size.y; }

FacePose posed(const dvec3& origin, const dvec3& forward) {
  const dvec3 f = glm::normalize(forward);
  const dvec3 right = glm::normalize(glm::cross(f, std::abs(f.y) < 0.8 ? dvec3(0, 1, 0) : dvec3(1, 0, 0)));
  return {.origin = origin, .right = right, .up = glm::cross(right, f), .forward = f};
}

}  // namespace

ClassifyScene empty_classify_scene(std::uint32_t face_size) {
  ViewSettings settings;
  settings.width = 96;
  settings.height = 72;
  settings.camera.near_m = 0.1f;
  settings.camera.fov_y = 1.0f;
  ClassifyScene scene;
  scene.view = make_view(settings, 0);
  scene.face_size = face_size;
  scene.tiles.resize(area(scene.grid()));
  return scene;
}

dvec3 random_unit(std::mt19937& random) {
  dvec3 v(0.0);
  while (!(glm::length(v) > 0.1 && glm::length(v) < 1.0))
    v = dvec3(between(random, -1.0, 1.0), between(random, -1.0, 1.0), between(random, -1.0, 1.0));
  return glm::normalize(v);
}

dvec3 direction_to(CubePart part, std::mt19937& random) {
  const int ones = part == CubePart::face_middle ? 1 : part == CubePart::edge ? 2 : 3;
  dvec3 v(0.0);
  for (int i = 0; i < ones; ++i) v[i] = random() % 2 == 0 ? 1.0 : -1.0;
  const auto turn = static_cast<int>(random() % 3);
  v = dvec3(v[turn], v[(turn + 1) % 3], v[(turn + 2) % 3]);
  return cube_axes() * glm::normalize(v + random_unit(random) * (ones == 1 ? 0.2 : 0.03));
}

ClassifyLight classify_spot(const dvec3& position, const dvec3& forward, double tan_half, double width) {
  ClassifyLight light{.kind = CastKind::spot, .vector = position, .width = width, .tan_inner = tan_half / 1.125};
  light.faces.push_back({.pose = posed(position, forward)});
  light.faces[0].pose.tan_half = tan_half;
  return light;
}

ClassifyLight classify_cube(const dvec3& position, double width) {
  ClassifyLight light{.kind = CastKind::cube, .vector = position, .width = width};
  for (int face = 0; face < 6; ++face) light.faces.push_back({.pose = cube_face(face, position, 1.125)});
  return light;
}

ClassifyLight classify_sun(const dvec3& direction, const dvec3& around, const glm::dvec2& half_extents_m,
                           double penumbra_m_per_m, std::uint32_t face_size) {
  ClassifyLight light{.kind = CastKind::sun, .vector = glm::normalize(direction), .width = penumbra_m_per_m};
  light.rim = face_size / 16.0;
  for (int i = 0; i < 2; ++i) {
    FacePose pose = posed(around - light.vector * 7.0, direction);
    pose.tan_half = pose.near_m = 0.0;
    pose.half_extent_m = half_extents_m[i];
    pose.depth_m = 16.0;
    light.faces.push_back({.pose = pose});
  }
  return light;
}

RayScene rectangle(const dvec3& middle, const dvec3& normal, const glm::dvec2& half_size) {
  const FacePose pose = posed(middle, normal);
  return plane(middle, normal, [=](const dvec3& p) {
    return std::abs(glm::dot(p - middle, pose.right)) < half_size.x &&
           std::abs(glm::dot(p - middle, pose.up)) < half_size.y;
  });
}

void draw_classify_maps(ClassifyScene& scene, const RayScene& casters) {
  std::uint32_t index = 0;
  for (ClassifyLight& light : scene.lights)
    for (ClassifyFace& face : light.faces) {
      face.origin = place_of_face(index++, scene.face_size, scene.atlas_size);
      face.depths = draw_face(face.pose, scene.face_size, casters);
    }
}

ClassifyImages classify_images(const ClassifyScene& scene) {
  ClassifyImages images;
  const uvec2 size = size_with_mips(scene.atlas_size);
  images.atlas.resize(area(size));
  images.pyramid.resize(2 * area(size_with_mips(scene.atlas_size / kPyramidBlock)));
  images.planes.resize(area(size_with_mips(scene.atlas_size / kPlaneBlock)));
  for (const ClassifyLight& light : scene.lights)
    for (const ClassifyFace& face : light.faces) {
      for (std::uint32_t y = 0; y < scene.face_size; ++y)
        std::copy_n(face.depths.begin() + y * scene.face_size, scene.face_size,
                    images.atlas.begin() + (face.origin.y + y) * size.x + face.origin.x);
      make_pyramid(scene, face, images.pyramid);
      make_planes(scene, face, images.planes);
    }
  return images;
}

std::vector<shaders::ShadowRow> classify_rows(const ClassifyScene& scene) {
  std::vector<shaders::ShadowRow> rows;
  for (const ClassifyLight& light : scene.lights) {
    if (light.kind == CastKind::sun) continue;
    rows.push_back(spot_row(light.faces[0].pose, light.tan_inner, light.width, light.faces[0].origin, scene.face_size));
    if (light.kind == CastKind::spot) continue;
    rows.back().kind = GLOAM_SHADOW_CUBE;
    for (std::size_t i = 0; i < 6; ++i) rows.back().origins[i] = vec2(light.faces[i].origin);
  }
  return rows;
}

void set_classify_sun(const ClassifyScene& scene, shaders::ShadowBlock& block) {
  const ClassifyLight& light = scene.lights[2];
  shaders::DirectionalShadow& sun = block.directional[0];
  sun.cascade_count = static_cast<std::uint32_t>(light.faces.size());
  sun.penumbra_m_per_m = static_cast<float>(light.width);
  sun.traced_layer = -1.0f;
  for (std::size_t i = 0; i < light.faces.size(); ++i) {
    const FacePose& pose = light.faces[i].pose;
    shaders::ShadowCascade& cascade = sun.cascades[i];
    const double size = scene.face_size, texel = 2.0 * pose.half_extent_m / size;
    const dvec3 u = pose.right / texel, v = -pose.up / texel, depth = -pose.forward / pose.depth_m;
    cascade.row_u = vec4(vec3(u), 0.5 * size - glm::dot(u, pose.origin));
    cascade.row_v = vec4(vec3(v), 0.5 * size - glm::dot(v, pose.origin));
    cascade.row_depth = vec4(vec3(depth), 1.0 - glm::dot(depth, pose.origin));
    cascade.origin = vec2(light.faces[i].origin);
    cascade.size = static_cast<float>(size);
    cascade.texel_m = static_cast<float>(texel);
    cascade.depth_m = static_cast<float>(pose.depth_m);
    cascade.rim = static_cast<float>(light.rim);
  }
}

std::optional<ClassifyPixel> pixel_on_plane(const RenderView& view, uvec2 tile, uvec2 at, const dvec3& point,
                                            const dvec3& normal) {
  const shaders::ViewConstants constants = view_constants(view);
  const glm::dvec2 pixel(tile * 8u + at);
  const dvec3 ray = dvec3(constants.ray_base) + pixel.x * dvec3(constants.ray_dx) + pixel.y * dvec3(constants.ray_dy);
  const double along = glm::dot(normal, ray);
  if (std::abs(along) < 0.02) return std::nullopt;
  const double distance = glm::dot(normal, point) / along, near = static_cast<double>(constants.ray_base.w);
  if (distance < 2.0 * near || distance > 200.0) return std::nullopt;
  ClassifyPixel made{.at = at, .depth = static_cast<float>(near / distance)};
  made.position = ray * (near / static_cast<double>(made.depth));
  made.face_normal = made.shading_normal = normal;
  return made;
}

shaders::ShadowTileGroup classify_group(std::span<const ClassifyPixel> pixels) {
  shaders::ShadowTileGroup group{};
  const dvec3 normal = pixels[0].face_normal;
  group.normal = vec3(normal);
  glm::dvec2 offsets(1e30, -1e30);
  double spread = 0.0, shading_spread = 0.0;
  group.depths = vec2(1.0f, 0.0f);
  uvec2 first(7), last(0);
  for (const ClassifyPixel& pixel : pixels) {
    const double along = glm::dot(dvec3(group.normal), pixel.position);
    offsets = {std::min(offsets.x, along), std::max(offsets.y, along)};
    spread = std::max(spread, glm::length(pixel.face_normal - dvec3(group.normal)));
    shading_spread = std::max(shading_spread, glm::length(pixel.shading_normal - dvec3(group.normal)));
    group.depths = {std::min(group.depths.x, pixel.depth), std::max(group.depths.y, pixel.depth)};
    first = glm::min(first, pixel.at);
    last = glm::max(last, pixel.at);
    if (pixel.subsurface) group.pixels |= GLOAM_GROUP_SUBSURFACE;
  }
  const auto up = [](double value) { return std::nextafter(static_cast<float>(value), 1e30f); };
  group.offsets = {-up(-offsets.x), up(offsets.y)};
  group.spread = up(spread);
  group.shading_spread = up(shading_spread);
  group.pixels |= first.x | first.y << 3 | last.x << 6 | last.y << 9;
  return group;
}

}  // namespace gloam::test

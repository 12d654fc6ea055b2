// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/bake/cube.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "engine/render/readback/geometry_picture.h"
#include "modules/lighting/outputs.h"
#include "modules/reflections/bake/capture_view.h"
#include "modules/reflections/bake/probe_map.h"
#include "modules/reflections/relighting/light_states.h"
#include "modules/reflections/scene_unit.h"

namespace gloam {
namespace {

constexpr double kProbeNear = 0.05;         // scene_unit()s
constexpr std::uint32_t kSurfaceSide = 32;  // pixels of the faces in which surfaces are looked up

/// A point of a cube: a face and the position on it, −1…1 to the right and up.
struct CubePoint {
  std::uint32_t face = 0;
  vec2 position = vec2(0.0f);
};

/// `d` must not be zero.
CubePoint cube_point(const vec3& d) {
  const vec3 size = glm::abs(d);
  if (size.x >= size.y && size.x >= size.z) {
    const float inverse = 1.0f / size.x;
    return d.x > 0.0f ? CubePoint{0, {d.z * inverse, d.y * inverse}} : CubePoint{1, {-d.z * inverse, d.y * inverse}};
  }
  if (size.y >= size.z) {
    const float inverse = 1.0f / size.y;
    return d.y > 0.0f ? CubePoint{2, {d.x * inverse, d.z * inverse}} : CubePoint{3, {-d.x * inverse, d.z * inverse}};
  }
  const float inverse = 1.0f / size.z;
  return d.z > 0.0f ? CubePoint{4, {-d.x * inverse, d.y * inverse}} : CubePoint{5, {d.x * inverse, d.y * inverse}};
}

vec3 direction_of(std::uint32_t face, const vec2& position) {
  const CubeFaceAxes axes = cube_face_axes(face);
  return vec3(axes.forward) + position.x * vec3(axes.right) + position.y * vec3(axes.up);
}

/// Centre of a texel of a face, −1…1 to the right and up. Rows count from the top.
vec2 texel_center(std::int32_t x, std::int32_t y, std::uint32_t side) {
  const float step = 2.0f / static_cast<float>(side);
  return {(static_cast<float>(x) + 0.5f) * step - 1.0f, 1.0f - (static_cast<float>(y) + 0.5f) * step};
}

/// Relative solid angle of a texel.
float weight_at(const vec2& position) { return std::pow(1.0f + glm::dot(position, position), -1.5f); }

}  // namespace

CubeFaceAxes cube_face_axes(std::uint32_t face) {
  CubeFaceAxes axes{dvec3(0.0), dvec3(0.0), face / 2 == 1 ? dvec3(0.0, 0.0, 1.0) : dvec3(0.0, 1.0, 0.0)};
  axes.forward[static_cast<int>(face / 2)] = face % 2 == 0 ? 1.0 : -1.0;
  axes.right = glm::cross(axes.forward, axes.up);
  return axes;
}

CapturedCube::CapturedCube(const std::array<CapturedPicture, 6>& faces, JobExecutor& executor) : side_(faces[0].width) {
  Level level{side_, std::vector<vec3>(std::size_t{6} * (side_ + 2) * (side_ + 2))};
  for (std::uint32_t face = 0; face < 6; ++face)
    for (std::uint32_t y = 0; y < side_; ++y)
      for (std::uint32_t x = 0; x < side_; ++x)
        level.texels[level.at(face, x + 1, y + 1)] = vec3(faces[face].texels[std::size_t{y} * side_ + x]);
  fill_borders(level);
  levels_.push_back(std::move(level));
  while (levels_.back().side > 1) levels_.push_back(halved(levels_.back(), executor));
}

void CapturedCube::fill_borders(Level& level) {
  const auto side = static_cast<std::int32_t>(level.side);
  const auto fill = [&](std::uint32_t face, std::int32_t x, std::int32_t y) {
    const CubePoint there = cube_point(direction_of(face, texel_center(x, y, level.side)));
    const auto index = [side](float position) {
      return static_cast<std::uint32_t>(
          std::clamp(static_cast<std::int32_t>((position * 0.5f + 0.5f) * static_cast<float>(side)), 0, side - 1));
    };
    level.texels[level.at(face, static_cast<std::uint32_t>(x + 1), static_cast<std::uint32_t>(y + 1))] =
        level.texels[level.at(there.face, index(there.position.x) + 1, index(-there.position.y) + 1)];
  };
  for (std::uint32_t face = 0; face < 6; ++face)
    for (std::int32_t i = -1; i <= side; ++i) {
      fill(face, i, -1);
      fill(face, i, side);
      fill(face, -1, i);
      fill(face, side, i);
    }
}

CapturedCube::Level CapturedCube::halved(const Level& fine, JobExecutor& executor) {
  const std::uint32_t side = fine.side / 2;
  Level level{side, std::vector<vec3>(std::size_t{6} * (side + 2) * (side + 2))};
  executor.parallel_for(std::size_t{6} * side, 16, [&](JobRange range) {
    for (std::size_t row = range.begin; row < range.end; ++row) {
      const auto face = static_cast<std::uint32_t>(row / side), y = static_cast<std::uint32_t>(row % side);
      for (std::uint32_t x = 0; x < side; ++x) {
        vec3 sum(0.0f);
        float weights = 0.0f;
        for (std::uint32_t child = 0; child < 4; ++child) {
          const std::uint32_t fine_x = 2 * x + child % 2, fine_y = 2 * y + child / 2;
          const float weight =
              weight_at(texel_center(static_cast<std::int32_t>(fine_x), static_cast<std::int32_t>(fine_y), fine.side));
          sum += weight * fine.texels[fine.at(face, fine_x + 1, fine_y + 1)];
          weights += weight;
        }
        level.texels[level.at(face, x + 1, y + 1)] = sum / weights;
      }
    }
  });
  fill_borders(level);
  return level;
}

vec3 CapturedCube::sample(const Level& level, std::uint32_t face, vec2 position) {
  const auto side = static_cast<float>(level.side);
  // In texels of the face with its border: 0.5 is the centre of the border.
  const float x = std::clamp((position.x * 0.5f + 0.5f) * side + 0.5f, 0.5f, side + 0.5f);
  const float y = std::clamp((0.5f - position.y * 0.5f) * side + 0.5f, 0.5f, side + 0.5f);
  const auto left = static_cast<std::uint32_t>(x), top = static_cast<std::uint32_t>(y);
  const float u = x - static_cast<float>(left), v = y - static_cast<float>(top);
  const vec3* const upper = &level.texels[level.at(face, left, top)];
  const vec3* const lower = upper + level.side + 2;
  return (1.0f - v) * ((1.0f - u) * upper[0] + u * upper[1]) + v * ((1.0f - u) * lower[0] + u * lower[1]);
}

vec3 CapturedCube::sample(const vec3& direction, float lod) const {
  const CubePoint point = cube_point(direction);
  const float last = static_cast<float>(levels_.size() - 1);
  const float level = std::clamp(lod, 0.0f, last);
  const auto fine = static_cast<std::size_t>(level);
  const float share = level - static_cast<float>(fine);
  const vec3 light = sample(levels_[fine], point.face, point.position);
  if (!(share > 0.0f)) return light;
  return glm::mix(light, sample(levels_[fine + 1], point.face, point.position), share);
}

ViewSettings face_view(std::uint32_t face, const dvec3& eye, std::uint32_t side, double unit_m) {
  const CubeFaceAxes axes = cube_face_axes(face);
  ViewSettings settings = capture_view(face);
  settings.width = settings.height = side;
  settings.camera.fov_y = std::numbers::pi_v<float> / 2.0f;
  settings.camera.near_m = static_cast<float>(kProbeNear * unit_m);
  settings.world_from_camera =
      dmat4(dvec4(axes.right, 0.0), dvec4(axes.up, 0.0), dvec4(-axes.forward, 0.0), dvec4(eye, 1.0));
  return settings;
}

namespace {

std::array<ViewRequest, 6> face_views(const dvec3& eye, std::uint32_t side, double unit_m) {
  std::array<ViewRequest, 6> requests;
  static_assert(kBakeViews / 2 == std::tuple_size_v<decltype(requests)>);
  for (std::uint32_t face = 0; face < requests.size(); ++face)
    requests[face].settings = face_view(face, eye, side, unit_m);
  return requests;
}

}  // namespace

Result<std::array<CapturedPicture, 6>> draw_cube_faces(Renderer& renderer, World& world, const dvec3& eye,
                                                       std::uint32_t side, float light_scale, CapturedLamps lamps) {
  std::array<ViewRequest, 6> requests = face_views(eye, side, scene_unit(world));
  if (world.try_resource<SurroundingsLeftOut>() != nullptr)
    for (ViewRequest& request : requests) request.settings.without.emplace_back("reflections");
  if (lamps == CapturedLamps::left_out)
    for (ViewRequest& request : requests) leave_lights_out(request.settings);
  GLOAM_TRY(renderer.render(world, requests));
  std::array<CapturedPicture, 6> faces;
  for (std::uint32_t face = 0; face < faces.size(); ++face) {
    const auto light = renderer.read_linear(requests[face].settings.id);
    if (!light.ok()) return light.error();
    CapturedPicture& picture = faces[face];
    picture = {light->width, light->height, {}};
    picture.texels.reserve(std::size_t{picture.width} * picture.height);
    for (std::size_t i = 0; i + 4 <= light->rgba.size(); i += 4)
      picture.texels.emplace_back(storable(light_scale * vec3(light->rgba[i], light->rgba[i + 1], light->rgba[i + 2])),
                                  1.0f);
  }
  return faces;
}

Result<std::vector<CapturedSurface>> probe_surfaces(Renderer& renderer, World& world, const dvec3& eye) {
  std::array<ViewRequest, 6> requests = face_views(eye, kSurfaceSide, scene_unit(world));
  for (ViewRequest& request : requests)
    for (const auto& module : renderer.modules()) request.settings.without.emplace_back(module->name());
  GLOAM_TRY(renderer.render(world, requests));
  std::vector<GeometryPicture> faces;
  for (const ViewRequest& request : requests) {
    auto face = renderer.read_geometry(world, request.settings.id);
    if (!face.ok()) return face.error();
    faces.push_back(std::move(face).value());
  }
  std::vector<CapturedSurface> surfaces;
  for (std::uint32_t y = 0; y < kProbeCells; ++y)
    for (std::uint32_t x = 0; x < kProbeCells; ++x) {
      const vec2 uv = (vec2(static_cast<float>(x), static_cast<float>(y)) + 0.5f) / static_cast<float>(kProbeCells);
      const CubePoint point = cube_point(probe_map_direction(uv));
      const auto pixel = [](float position) {
        const float at = (position * 0.5f + 0.5f) * static_cast<float>(kSurfaceSide);
        return static_cast<std::uint32_t>(std::clamp(at, 0.0f, static_cast<float>(kSurfaceSide) - 1.0f));
      };
      const std::uint32_t px = pixel(point.position.x), py = pixel(-point.position.y);
      const GeometryPicture& face = faces[point.face];
      const std::size_t at = std::size_t{py} * kSurfaceSide + px;
      CapturedSurface& surface = surfaces.emplace_back();
      if (face.is_sky(at)) continue;
      surface.position = vec3(face.position(px, py));
      surface.normal = face.texel(at).face_normal;
      if (glm::dot(surface.normal, surface.position) > 0.0f) surface.normal = -surface.normal;
    }
  return surfaces;
}

}  // namespace gloam

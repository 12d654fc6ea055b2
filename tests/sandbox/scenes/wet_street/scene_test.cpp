// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/scenes/wet_street/scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <limits>
#include <string>
#include <vector>

#include "engine/ecs/view.h"
#include "engine/scene/assets.h"
#include "engine/scene/resources.h"
#include "modules/lights/components.h"
#include "modules/module_list/module_list.h"
#include "modules/reflections/components.h"
#include "modules/reflections/culling/placed.h"
#include "modules/reflections/culling/rooms.h"
#include "modules/shadows/components.h"

namespace gloam {
namespace {

dmat4 street_matrix(const LocalTransform& local) {
  return glm::translate(dmat4(1.0), local.translation) * glm::mat4_cast(local.rotation) *
         glm::scale(dmat4(1.0), local.scale);
}

struct StreetTriangle {
  dvec3 a, b, c;
};

/// One instance's triangles, world space.
struct StreetPart {
  std::string name;
  bool is_wet = false;  ///< its material reflects as a mirror does
  dvec3 min = dvec3(std::numeric_limits<double>::infinity());
  dvec3 max = dvec3(-std::numeric_limits<double>::infinity());
  std::vector<StreetTriangle> triangles;
};

struct StreetHit {
  double distance = std::numeric_limits<double>::infinity();
  const StreetPart* part = nullptr;
  dvec3 normal = dvec3(0.0);  ///< towards the ray's origin
};

bool meets_box(const StreetPart& part, const dvec3& from, const dvec3& along, double limit) {
  const dvec3 a = (part.min - from) / along, b = (part.max - from) / along;
  double near = 0.0, far = limit;
  for (int i = 0; i < 3; ++i) {
    near = std::max(near, std::min(a[i], b[i]));
    far = std::min(far, std::max(a[i], b[i]));
  }
  return near <= far + 1e-6;
}

/// Distance to the triangle from either side; infinity if the ray misses it.
double meet(const StreetTriangle& t, const dvec3& from, const dvec3& along) {
  const dvec3 u = t.b - t.a, v = t.c - t.a, p = glm::cross(along, v);
  const double det = glm::dot(u, p);
  constexpr double kMiss = std::numeric_limits<double>::infinity();
  if (std::abs(det) < 1e-14) return kMiss;
  const dvec3 s = from - t.a, q = glm::cross(s, u);
  const double x = glm::dot(s, p) / det, y = glm::dot(along, q) / det, d = glm::dot(v, q) / det;
  return x < 0.0 || y < 0.0 || x + y > 1.0 || d < 1e-4 ? kMiss : d;
}

struct Street {
  World world;
  SceneInfo info;
  std::vector<StreetPart> parts;
  std::vector<PlacedProxy> proxies;
  std::vector<PlacedRoom> rooms;

  Street() {
    prepare_scene_world(world);
    for (const auto& module : make_all_modules()) module->register_components(world);
    build_wet_street_scene(world, info);
    const auto& assets = world.resource<SceneAssets>();
    world.view<const MeshInstance, const LocalTransform>().each(
        [&](Entity entity, const MeshInstance& instance, const LocalTransform& local) {
          const Primitive& shape = assets.meshes[instance.mesh].primitives[0];
          const Material& material = assets.materials[shape.material];
          add_part(std::string(world.resource<SceneNames>().name_of(entity)), shape, street_matrix(local),
                   material.roughness < 0.9f);
        });
    world.view<const IbrProxy, const LocalTransform>().each(
        [&](Entity entity, const IbrProxy& proxy, const LocalTransform& local) {
          EXPECT_EQ(place_proxy(entity, proxy, street_matrix(local), proxies.emplace_back()), ProxyPlacement::placed);
        });
    world.view<const IbrRoom, const LocalTransform, Maybe<const ReflectingHeights>>().each(
        [&](Entity entity, const IbrRoom& room, const LocalTransform& local, const ReflectingHeights* heights) {
          EXPECT_TRUE(place_room(entity, room, heights, street_matrix(local), rooms.emplace_back()));
        });
  }

  void add_part(std::string name, const Primitive& shape, const dmat4& to_world, bool is_wet) {
    StreetPart& part = parts.emplace_back();
    part.name = std::move(name);
    part.is_wet = is_wet;
    std::vector<dvec3> corners;
    for (const vec3& position : shape.positions) {
      corners.emplace_back(to_world * dvec4(dvec3(position), 1.0));
      part.min = glm::min(part.min, corners.back());
      part.max = glm::max(part.max, corners.back());
    }
    for (std::size_t i = 0; i < shape.indices.size(); i += 3)
      part.triangles.push_back(
          {corners[shape.indices[i]], corners[shape.indices[i + 1]], corners[shape.indices[i + 2]]});
  }

  [[nodiscard]] StreetHit trace(const dvec3& from, const dvec3& along) const {
    StreetHit hit;
    for (const StreetPart& part : parts) {
      if (!meets_box(part, from, along, hit.distance)) continue;
      for (const StreetTriangle& t : part.triangles) {
        const double distance = meet(t, from, along);
        if (distance >= hit.distance) continue;
        const dvec3 normal = glm::normalize(glm::cross(t.b - t.a, t.c - t.a));
        hit = {distance, &part, glm::dot(normal, along) < 0.0 ? normal : -normal};
      }
    }
    return hit;
  }

  /// Distance to the first proxy that faces the ray; `chosen`: only those of rooms of the camera, see choose_rooms().
  [[nodiscard]] double trace_proxies(const dvec3& from, const dvec3& along, const dvec3& camera,
                                     const std::vector<std::uint32_t>& chosen) const {
    double nearest = std::numeric_limits<double>::infinity();
    for (const PlacedProxy& p : proxies) {
      const double towards = glm::dot(p.normal, along);
      if (towards >= 0.0) continue;
      const double distance = glm::dot(p.normal, p.center - from) / towards;
      const dvec3 place = from + along * distance - p.center;
      const bool is_inside = std::abs(glm::dot(place, p.half_u)) <= glm::dot(p.half_u, p.half_u) &&
                             std::abs(glm::dot(place, p.half_v)) <= glm::dot(p.half_v, p.half_v);
      if (distance <= 0.0 || distance >= nearest || !is_inside) continue;
      const ReceiverBands bands = receiver_bands(p, rooms, chosen, camera);
      const bool is_served = std::ranges::any_of(
          bands.all(), [&](const ReceiverBand& band) { return from.y >= band.lowest_m && from.y <= band.highest_m; });
      if (is_served) nearest = distance;
    }
    return nearest;
  }
};

struct Coverage {
  int wet = 0;      ///< pixels of wet ground
  int facade = 0;   ///< of these: reflected rays that hit a facade
  int covered = 0;  ///< of these: a proxy lies within 0.25 m of the hit
  int solid = 0;    ///< reflected rays that hit anything
};

Coverage coverage_of(const Street& street, Entity camera, int columns) {
  const auto& local = street.world.get<LocalTransform>(camera);
  const double tan_half = std::tan(0.5 * static_cast<double>(street.world.get<Camera>(camera).fov_y));
  std::vector<std::uint32_t> chosen;
  choose_rooms(street.rooms, local.translation, chosen);
  Coverage coverage;
  const int rows = columns * 9 / 16;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const dvec3 ray((2.0 * (column + 0.5) / columns - 1.0) * tan_half * 16.0 / 9.0,
                      (1.0 - 2.0 * (row + 0.5) / rows) * tan_half, -1.0);
      const dvec3 along = local.rotation * glm::normalize(ray);
      const StreetHit ground = street.trace(local.translation, along);
      if (ground.part == nullptr || !ground.part->is_wet || ground.normal.y < 0.99) continue;
      ++coverage.wet;
      const dvec3 from = local.translation + along * ground.distance, up(along.x, -along.y, along.z);
      const StreetHit hit = street.trace(from, up);
      if (hit.part == nullptr) continue;
      ++coverage.solid;
      if (!hit.part->name.starts_with("facade")) continue;
      ++coverage.facade;
      const double proxy = street.trace_proxies(from, up, local.translation, chosen);
      coverage.covered += std::abs(proxy - hit.distance) <= 0.25 ? 1 : 0;
    }
  }
  return coverage;
}

TEST(WetStreetScene, has_50_proxies_in_4_rooms_with_5_probes) {
  Street street;
  EXPECT_EQ(street.proxies.size(), static_cast<std::size_t>(kWetStreetProxies));
  EXPECT_EQ(street.rooms.size(), static_cast<std::size_t>(kWetStreetRooms));
  int fires = 0, global = 0, local = 0, facing_down = 0;
  street.world.view<const IbrProxy>().each(
      [&](const IbrProxy& proxy) { fires += proxy.kind == IbrProxyKind::fire ? 1 : 0; });
  street.world.view<const CubeProbe>().each([&](const CubeProbe& probe) { ++(probe.global ? global : local); });
  for (const PlacedProxy& proxy : street.proxies) facing_down += proxy.normal.y < -0.99 ? 1 : 0;
  EXPECT_EQ(fires, 1);
  EXPECT_EQ(local, 4);
  EXPECT_EQ(global, 1);
  EXPECT_GE(facing_down, 1);
}

TEST(WetStreetScene, has_60_lamps_of_which_12_cast_soft_shadows) {
  Street street;
  int lamps = 0, casting = 0;
  street.world.view<const Light, Maybe<const ShadowCaster>>().each([&](const Light& light, const ShadowCaster* caster) {
    EXPECT_NE(light.kind, LightKind::directional);
    EXPECT_GT(light.intensity, 0.0f);
    EXPECT_GT(light.range_m, 0.0f);
    ++lamps;
    if (caster != nullptr && !caster->enabled) return;
    ++casting;
    EXPECT_GT(light.width_m, 0.0f);
  });
  EXPECT_EQ(lamps, kWetStreetLamps);
  EXPECT_EQ(casting, kWetStreetCasting);
}

TEST(WetStreetScene, every_proxy_lies_in_a_room_and_every_room_has_proxies_of_its_own) {
  Street street;
  std::vector<int> in_room(street.rooms.size()), only_in_room(street.rooms.size());
  for (const PlacedProxy& proxy : street.proxies) {
    std::vector<std::uint32_t> rooms;
    choose_rooms(street.rooms, proxy.center, rooms);
    EXPECT_FALSE(rooms.empty()) << street.world.resource<SceneNames>().name_of(proxy.entity);
    for (const std::uint32_t room : rooms) ++in_room[room];
    if (rooms.size() == 1) ++only_in_room[rooms[0]];
  }
  for (std::size_t i = 0; i < in_room.size(); ++i) {
    EXPECT_GE(only_in_room[i], 2) << i;
    EXPECT_LE(in_room[i], 30) << i;
  }
}

TEST(WetStreetScene, every_camera_is_in_a_room_and_inside_of_nothing) {
  Street street;
  EXPECT_EQ(street.info.cameras.size(), 6u);
  for (const Entity camera : street.info.cameras) {
    const dvec3 eye = street.world.get<LocalTransform>(camera).translation;
    std::vector<std::uint32_t> rooms;
    choose_rooms(street.rooms, eye, rooms);
    EXPECT_FALSE(rooms.empty());
    for (const StreetPart& part : street.parts) {
      const bool is_inside = glm::all(glm::greaterThan(eye, part.min)) && glm::all(glm::lessThan(eye, part.max));
      EXPECT_FALSE(is_inside && part.name.find("lamp") != std::string::npos) << part.name;
    }
    EXPECT_GT(street.trace(eye, glm::normalize(dvec3(0.01, -1.0, 0.02))).normal.y, 0.5) << "stands on a floor";
  }
}

TEST(WetStreetScene, every_proxy_has_its_surface_close_behind_it) {
  Street street;
  for (const PlacedProxy& proxy : street.proxies) {
    int close = 0, all = 0;
    for (double s = -0.95; s < 1.0; s += 0.31) {
      for (double t = -0.95; t < 1.0; t += 0.31, ++all) {
        const dvec3 from = proxy.center + s * proxy.half_u + t * proxy.half_v + 0.12 * proxy.normal;
        close += std::abs(street.trace(from, -proxy.normal).distance - 0.12) < 0.25 ? 1 : 0;
      }
    }
    const bool is_fire = street.world.get<IbrProxy>(proxy.entity).kind == IbrProxyKind::fire;
    EXPECT_GE(close, is_fire ? all / 4 : all - 3) << street.world.resource<SceneNames>().name_of(proxy.entity);
  }
}

TEST(WetStreetScene, proxies_stand_for_the_facades_that_wet_ground_reflects) {
  Street street;
  Coverage sum;
  for (const Entity camera : street.info.cameras) {
    const Coverage c = coverage_of(street, camera, 40);
    const std::string name(street.world.resource<SceneNames>().name_of(camera));
    EXPECT_GT(c.wet, 300) << name;
    EXPECT_GE(c.covered, c.facade * 7 / 10) << name;
    sum.facade += c.facade;
    sum.covered += c.covered;
  }
  EXPECT_GE(sum.covered, sum.facade * 8 / 10);
}

}  // namespace
}  // namespace gloam

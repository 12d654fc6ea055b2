// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/debug/unseen.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include "engine/ecs/view.h"
#include "engine/scene/assets.h"
#include "engine/scene/components.h"
#include "engine/scene/posing/animated_nodes.h"
#include "engine/scene/resources.h"
#include "modules/reflections/components.h"
#include "modules/reflections/culling/placed.h"
#include "modules/reflections/culling/rooms.h"
#include "modules/reflections/materials.h"
#include "modules/reflections/scene_unit.h"

namespace gloam {
namespace {

using glm::dvec2;

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kLeastUp = 0.86;  // less than kMostTilt of shaders/reflections/surfaces_api.glsl, 0.866

struct SurfaceBox {
  dvec3 min = dvec3(kInfinite);
  dvec3 max = dvec3(-kInfinite);
  void grow(const dvec3& p) {
    min = glm::min(min, p);
    max = glm::max(max, p);
  }
  [[nodiscard]] bool empty() const { return !(min.x <= max.x); }
  [[nodiscard]] dvec3 corner(int i) const {
    return {i & 1 ? max.x : min.x, i & 2 ? max.y : min.y, i & 4 ? max.z : min.z};
  }
};

/// Surfaces of one kind in world space, a box for each primitive of an instance.
struct SurfaceBoxes {
  std::vector<SurfaceBox> boxes;
  bool anywhere = false;  ///< there is also one that moves or bends
  [[nodiscard]] bool none() const { return boxes.empty() && !anywhere; }
};

struct ReflectingSurfaces {
  SurfaceBoxes mirrors;  ///< the triangles that face up of smooth materials: they show proxies
  SurfaceBoxes all;      ///< they show probes
  bool smooth = false;   ///< there is a smooth surface, facing anywhere
};

/// How surfaces of a material reflect. For probes, blended surfaces count like opaque ones.
struct SurfaceKind {
  bool shows_probes = false;
  bool mirrors = false;
  bool both_sides = false;
};

SurfaceKind kind_of(Material material) {
  SurfaceKind kind;
  kind.mirrors = reflective(material) == Reflective::mirror;
  kind.both_sides = material.double_sided;
  material.alpha_mode = AlphaMode::opaque;
  kind.shows_probes = reflective(material) != Reflective::no;
  return kind;
}

/// Box of the triangles that face up; with `both_sides`, or down.
SurfaceBox box_facing_up(const Primitive& primitive, const dmat4& world_from_mesh, bool both_sides) {
  const double side = glm::determinant(glm::dmat3(world_from_mesh)) < 0.0 ? -1.0 : 1.0;
  SurfaceBox box;
  for (std::size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
    dvec3 corners[3];
    for (std::size_t k = 0; k < 3; ++k)
      corners[k] = dvec3(world_from_mesh * dvec4(dvec3(primitive.positions[primitive.indices[i + k]]), 1.0));
    const dvec3 normal = side * glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    const double up = both_sides ? std::abs(normal.y) : normal.y;
    if (up < kLeastUp * glm::length(normal)) continue;
    for (const dvec3& corner : corners) box.grow(corner);
  }
  return box;
}

SurfaceBox box_of(const Primitive& primitive, const dmat4& world_from_mesh) {
  SurfaceBox box;
  for (const vec3& position : primitive.positions) box.grow(dvec3(world_from_mesh * dvec4(dvec3(position), 1.0)));
  return box;
}

ReflectingSurfaces find_surfaces(const World& world, const AnimatedNodes& animated) {
  const auto& assets = world.resource<SceneAssets>();
  std::vector<SurfaceKind> kinds;
  for (const Material& material : assets.materials) kinds.push_back(kind_of(material));
  kinds.push_back(kind_of({}));  // of primitives without a material
  ReflectingSurfaces found;
  world.view<const MeshInstance, const WorldTransform, Maybe<const MorphInstance>>().each(
      [&](Entity entity, const MeshInstance& instance, const WorldTransform& transform, const MorphInstance* morph) {
        if (instance.mesh >= assets.meshes.size()) return;
        const bool moves = instance.skin != kNone || morph != nullptr || animated.moves(entity);
        for (const Primitive& primitive : assets.meshes[instance.mesh].primitives) {
          const SurfaceKind kind = kinds[std::min<std::size_t>(primitive.material, assets.materials.size())];
          if (!kind.shows_probes) continue;
          found.smooth |= kind.mirrors;
          found.all.anywhere |= moves;
          found.mirrors.anywhere |= moves && kind.mirrors;
          if (moves) continue;
          found.all.boxes.push_back(box_of(primitive, transform.matrix));
          if (!kind.mirrors) continue;
          const SurfaceBox box = box_facing_up(primitive, transform.matrix, kind.both_sides);
          if (!box.empty()) found.mirrors.boxes.push_back(box);
        }
      });
  return found;
}

/// Whether the segment between two points meets the quadrant x < 0, y > 0.
bool meets_quadrant(const dvec2& a, const dvec2& b) {
  double first = 0.0, last = 1.0;
  const auto keep_positive = [&](double from, double to) {  // where from + t (to − from) > 0
    if (from <= 0.0 && to <= 0.0) first = 2.0;
    if (from <= 0.0 && to > 0.0) first = std::max(first, from / (from - to));
    if (from > 0.0 && to <= 0.0) last = std::min(last, from / (from - to));
  };
  keep_positive(-a.x, -b.x);
  keep_positive(a.y, b.y);
  return first < last || (first == last && a.x < 0.0 && a.y > 0.0);
}

/// Whether a ray that rises from a point of the box at these heights may meet the front of the proxy. Exact for a box
/// and a quad: the differences of their points are a convex body, of which a part must lie below and in front.
bool may_show(const SurfaceBox& surface, double lowest, double highest, const PlacedProxy& proxy) {
  SurfaceBox box = surface;
  box.min.y = std::max(box.min.y, lowest);
  box.max.y = std::min(box.max.y, highest);
  if (!(box.min.y <= box.max.y)) return false;
  std::array<dvec2, 32> differences;
  const std::array<dvec3, 4> corners = proxy.corners();
  for (int i = 0; i < 32; ++i) {
    const dvec3 d = box.corner(i & 7) - corners[static_cast<std::size_t>(i >> 3)];
    differences[static_cast<std::size_t>(i)] = {d.y, glm::dot(proxy.normal, d)};
  }
  for (const dvec2& a : differences)
    for (const dvec2& b : differences)
      if (meets_quadrant(a, b)) return true;
  return false;
}

bool may_show(const SurfaceBoxes& surfaces, double lowest, double highest, const PlacedProxy& proxy) {
  return surfaces.anywhere || std::ranges::any_of(surfaces.boxes, [&](const SurfaceBox& box) {
           return may_show(box, lowest, highest, proxy);
         });
}

/// The reasons for which a proxy is never shown; their sentences follow "no surface shows … because ".
enum class Unseen : std::uint8_t { no_area, no_mirror, none_up, below_or_behind, height, tiers };
constexpr std::string_view kUnseenTexts[] = {
    "a side of it is zero or not finite",
    "the scene has no smooth material",
    "no smooth surface faces up",
    "it faces away from or lies below every smooth surface that faces up",
    "no smooth surface lies at a height that its rooms serve",
    "gloam.ibr_room.tiers of its rooms leaves proxies out",
};

/// Whether a camera in one of the proxy's rooms may be governed by a room whose tiers have proxies.
bool rooms_have_proxies(std::span<const PlacedRoom> rooms, const PlacedProxy& proxy, double unit) {
  double largest = -1.0;
  for (const PlacedRoom& room : rooms)
    if (contains(room, proxy.center, unit)) largest = std::max(largest, room.volume_m3);
  return largest < 0.0 ||
         std::ranges::any_of(rooms, [&](const PlacedRoom& room) { return room.proxies && room.volume_m3 <= largest; });
}

/// rooms: null if they may move.
std::optional<Unseen> never_shown(const PlacedProxy& proxy, const ReflectingSurfaces& surfaces,
                                  const std::vector<PlacedRoom>* rooms, double unit) {
  if (!surfaces.smooth) return Unseen::no_mirror;
  if (surfaces.mirrors.none()) return Unseen::none_up;
  if (!may_show(surfaces.mirrors, -kInfinite, kInfinite, proxy)) return Unseen::below_or_behind;
  if (rooms == nullptr) return std::nullopt;
  if (!rooms_have_proxies(*rooms, proxy, unit)) return Unseen::tiers;
  bool in_room = false;
  for (std::uint32_t i = 0; i < rooms->size(); ++i) {
    const PlacedRoom& room = (*rooms)[i];
    if (!contains(room, proxy.center, unit)) continue;
    in_room = true;
    // The camera is in the room and above the surface.
    const double top = 2.0 * room.center.y - room.floor_m + kRoomFaceSlack * unit;
    const std::uint32_t chosen[] = {i};
    const ReceiverBands bands = receiver_bands(proxy, *rooms, chosen, room.center, unit);
    for (const ReceiverBand& band : bands.all())
      if (may_show(surfaces.mirrors, band.lowest_m, std::min(band.highest_m, top), proxy)) return std::nullopt;
  }
  return in_room ? std::optional(Unseen::height) : std::nullopt;
}

/// Whether a surface may reach into the box.
bool reaches(const SurfaceBoxes& surfaces, const PlacedRoom& box) {
  return surfaces.anywhere || std::ranges::any_of(surfaces.boxes, [&](const SurfaceBox& surface) {
           return std::ranges::all_of(box.to_face, [&](const dvec3& to_face) {
             double least = kInfinite, most = -kInfinite;
             for (int i = 0; i < 8; ++i) {
               const double at = glm::dot(to_face, surface.corner(i) - box.center);
               least = std::min(least, at);
               most = std::max(most, at);
             }
             return least <= 1.0 && most >= -1.0;
           });
         });
}

constexpr std::size_t kMostNames = 24;  // in one sentence

/// "2 reflection proxies: east, west"
std::string counted(const World& world, std::vector<Entity> entities, const char* one, const char* many) {
  std::ranges::sort(entities, {}, [](Entity entity) { return entity.index; });
  std::string text = std::to_string(entities.size()) + (entities.size() == 1 ? one : many) + ": ";
  for (std::size_t i = 0; i < std::min(entities.size(), kMostNames); ++i) {
    const std::string_view name = world.resource<SceneNames>().name_of(entities[i]);
    text += (i == 0 ? "" : ", ") + (name.empty() ? "(no name)" : std::string(name));
  }
  if (entities.size() > kMostNames) text += " and " + std::to_string(entities.size() - kMostNames) + " more";
  return text;
}

std::string sentence(const World& world, std::vector<Entity> entities, const char* one, const char* many,
                     std::string_view reason) {
  return "no surface shows " + counted(world, std::move(entities), one, many) + ", because " + std::string(reason);
}

/// The rooms of the world; those without a box go to `unusable`. None if one may move.
std::optional<std::vector<PlacedRoom>> place_rooms(const World& world, const AnimatedNodes& animated,
                                                   std::vector<Entity>& unusable) {
  std::vector<PlacedRoom> rooms;
  bool moves = false;
  world.view<const IbrRoom, const WorldTransform, Maybe<const ReflectingHeights>>().each(
      [&](Entity entity, const IbrRoom& room, const WorldTransform& transform, const ReflectingHeights* heights) {
        PlacedRoom placed;
        moves |= animated.moves(entity);
        if (place_room(entity, room, heights, transform.matrix, placed))
          rooms.push_back(std::move(placed));
        else
          unusable.push_back(entity);
      });
  return moves ? std::nullopt : std::optional(std::move(rooms));
}

void add_proxies(const World& world, const AnimatedNodes& animated, const ReflectingSurfaces& surfaces,
                 const std::vector<PlacedRoom>* rooms, std::vector<std::string>& sentences) {
  std::vector<Entity> unseen[std::size(kUnseenTexts)];
  world.view<const IbrProxy, const WorldTransform, Maybe<const FlameProxy>>().each(
      [&](Entity entity, const IbrProxy& proxy, const WorldTransform& transform, const FlameProxy* flame) {
        if (flame != nullptr || (animated.moves(entity) && !surfaces.mirrors.none())) return;
        PlacedProxy placed;
        std::optional<Unseen> why = Unseen::no_area;
        if (place_proxy(entity, proxy, transform.matrix, placed) == ProxyPlacement::placed)
          why = never_shown(placed, surfaces, rooms, scene_unit(world));
        if (why) unseen[static_cast<std::size_t>(*why)].push_back(entity);
      });
  for (std::size_t i = 0; i < std::size(kUnseenTexts); ++i)
    if (!unseen[i].empty())
      sentences.push_back(sentence(world, unseen[i], " reflection proxy", " reflection proxies", kUnseenTexts[i]));
}

void add_probes(const World& world, const AnimatedNodes& animated, const ReflectingSurfaces& surfaces,
                std::vector<std::string>& sentences) {
  std::vector<Entity> unseen;
  world.view<const CubeProbe, const WorldTransform>().each(
      [&](Entity entity, const CubeProbe& probe, const WorldTransform& transform) {
        if (surfaces.all.none()) unseen.push_back(entity);
        if (surfaces.all.none() || probe.global || animated.moves(entity)) return;
        PlacedRoom box;  // a room's box is described in the same way
        const bool placed = place_room(entity, {.size_m = probe.size_m}, nullptr, transform.matrix, box);
        if (!placed || !reaches(surfaces.all, box)) unseen.push_back(entity);
      });
  if (unseen.empty()) return;
  const char* reason =
      surfaces.all.none() ? "the scene has no reflective material" : "no reflective surface reaches into its box";
  sentences.push_back(sentence(world, unseen, " probe", " probes", reason));
}

}  // namespace

std::vector<std::string> unseen_captures(const World& world) {
  std::vector<std::string> sentences;
  if (world.view<const IbrProxy>().size() + world.view<const CubeProbe>().size() + world.view<const IbrRoom>().size() ==
      0)
    return sentences;
  const AnimatedNodes animated(world);
  const ReflectingSurfaces surfaces = find_surfaces(world, animated);
  std::vector<Entity> unusable;
  const auto rooms = place_rooms(world, animated, unusable);
  add_proxies(world, animated, surfaces, rooms ? &*rooms : nullptr, sentences);
  add_probes(world, animated, surfaces, sentences);
  if (!unusable.empty())
    sentences.push_back("no effect have " + counted(world, unusable, " IBR room", " IBR rooms") +
                        ", because gloam.ibr_room.size is absent or a side of the box is zero");
  return sentences;
}

}  // namespace gloam

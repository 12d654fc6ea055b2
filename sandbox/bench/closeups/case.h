// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "engine/core/result.h"
#include "engine/ecs/entity.h"
#include "engine/ecs/world.h"
#include "engine/render/readback/geometry_picture.h"
#include "engine/scene/components.h"
#include "modules/closeups/pairs/views.h"
#include "modules/shadows/filter/traced_visibility.h"
#include "sandbox/bench/harness/context.h"
#include "sandbox/bench/shadows/case.h"
#include "sandbox/session/session.h"

namespace gloam {

inline constexpr const char* kCloseupScene = "builtin:closeups";  // unless the user names one

/// A session for close-ups: of the scene that the user named, or one of its own of the built-in scene with that many
/// figures as subjects.
struct CloseupSession {
  std::unique_ptr<Session> own;
  Session* session = nullptr;
};
[[nodiscard]] Result<CloseupSession> open_closeups(BenchContext& context, int figures);

/// While it lives, only these lights cast shadows. For tracing: put back, nothing has changed.
class OnlyCasting {
 public:
  OnlyCasting(World& world, std::span<const Entity> lights);
  ~OnlyCasting();
  OnlyCasting(const OnlyCasting&) = delete;
  OnlyCasting& operator=(const OnlyCasting&) = delete;

 private:
  World& world_;
  std::vector<Entity> added_;     ///< had no ShadowCaster
  std::vector<Entity> disabled_;  ///< had an enabled one
};

/// While it lives, these entities have no meshes.
class WithoutMeshes {
 public:
  WithoutMeshes(World& world, std::span<const Entity> casters);
  ~WithoutMeshes();
  WithoutMeshes(const WithoutMeshes&) = delete;
  WithoutMeshes& operator=(const WithoutMeshes&) = delete;

 private:
  World& world_;
  std::vector<std::pair<Entity, MeshInstance>> taken_;
};

/// Visibility of these lights in the view's last frame, by triangles of the world as it is now.
[[nodiscard]] Result<TracedVisibility> trace_lights(Session& session, const GeometryPicture& geometry,
                                                    std::span<const Entity> lights, std::uint32_t samples);

/// One byte a pixel: whether the surface there faces the light, or lets light through. Of the others final lists may
/// hold anything: the light gives them nothing.
[[nodiscard]] std::vector<std::uint8_t> pixels_that_face(const World& world, const GeometryPicture& geometry,
                                                         Entity light);

/// Texels of shadow maps in a view's last frame: of what is in the atlas, and of the maps of its pairs.
struct MapTexels {
  std::uint64_t standard = 0;
  std::uint64_t closeups = 0;
  [[nodiscard]] std::uint64_t total() const { return standard + closeups; }
};
[[nodiscard]] MapTexels map_texels(const Session& session);

/// Shadows with close-ups and with standard maps alone, with as many texels: ShadowSettings' texels_per_pixel of each.
struct EqualTexels {
  double with_density = 0.0;
  double standard_density = 0.0;
  std::uint64_t with = 0;      ///< texels of all maps, close-ups' included; at most `standard`
  std::uint64_t standard = 0;  ///< texels of standard maps
};
/// most_pairs: closeups.max_pairs with close-ups. closeup_texels: counted of close-up maps, whatever the frame has; 0:
/// as the frame has. Sets shadows.atlas, which has room for both.
[[nodiscard]] Result<EqualTexels> find_equal_texels(ShadowCase& shadows, const char* most_pairs,
                                                    std::uint64_t closeup_texels = 0);
/// Knobs for one side or the other; draws frames.
[[nodiscard]] Status use_closeups(ShadowCase& shadows, const EqualTexels& texels, const char* most_pairs);
[[nodiscard]] Status use_standard(ShadowCase& shadows, const EqualTexels& texels);

}  // namespace gloam

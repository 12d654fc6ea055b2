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

inline constexpr const char* kCloseupScene = "builtin:closeups";  // unless the user names a scene

/// A session for close-up benches: the shared session of the scene that the user named, or else a separate session of
/// the built-in scene with `figures` close-up subjects.
struct CloseupSession {
  std::unique_ptr<Session> own;
  Session* session = nullptr;
};
[[nodiscard]] Result<CloseupSession> open_closeups(BenchContext& context, int figures);

/// During its lifetime only these lights cast shadows. For tracing; the destructor restores the world.
class OnlyCasting {
 public:
  OnlyCasting(World& world, std::span<const Entity> lights);
  ~OnlyCasting();
  OnlyCasting(const OnlyCasting&) = delete;
  OnlyCasting& operator=(const OnlyCasting&) = delete;

 private:
  World& world_;
  std::vector<Entity> added_;     ///< lights that had no ShadowCaster
  std::vector<Entity> disabled_;  ///< lights whose ShadowCaster was enabled
};

/// During its lifetime these entities have no meshes. The destructor restores them.
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

/// Traces the visibility of these lights at the surfaces of `geometry`, against the world's current triangles.
[[nodiscard]] Result<TracedVisibility> trace_lights(Session& session, const GeometryPicture& geometry,
                                                    std::span<const Entity> lights, std::uint32_t samples);

/// One byte per pixel: 1 if the surface faces the light or has a subsurface material. The light gives nothing to other
/// pixels, so final lists may hold any visibility for them.
[[nodiscard]] std::vector<std::uint8_t> pixels_that_face(const World& world, const GeometryPicture& geometry,
                                                         Entity light);

/// Texels of shadow maps in a view's last frame: of the faces in the atlas (standard) and of the pairs' close-up maps.
struct MapTexels {
  std::uint64_t standard = 0;
  std::uint64_t closeups = 0;
  [[nodiscard]] std::uint64_t total() const { return standard + closeups; }
};
[[nodiscard]] MapTexels map_texels(const Session& session);

/// Densities (shadows.texels_per_pixel) with which shadows with close-ups and shadows with standard maps alone have
/// about the same number of texels.
struct EqualTexels {
  double with_density = 0.0;
  double standard_density = 0.0;
  std::uint64_t with = 0;      ///< texels of all maps, close-up maps included; at most `standard`
  std::uint64_t standard = 0;  ///< texels of standard maps
};
/// most_pairs: closeups.max_pairs with close-ups. closeup_texels: number of close-up texels to assume; 0: that of the
/// frame. Sets shadows.atlas to a size with room for both. ErrorKind::failed if the camera shows no close-up or no
/// density fits.
[[nodiscard]] Result<EqualTexels> find_equal_texels(ShadowCase& shadows, const char* most_pairs,
                                                    std::uint64_t closeup_texels = 0);
/// Set the knobs of one side and draw frames with them.
[[nodiscard]] Status use_closeups(ShadowCase& shadows, const EqualTexels& texels, const char* most_pairs);
[[nodiscard]] Status use_standard(ShadowCase& shadows, const EqualTexels& texels);

}  // namespace gloam

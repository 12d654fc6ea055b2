// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/log.h"
#include "engine/core/result.h"
#include "engine/ecs/world.h"
#include "engine/jobs/executor.h"
#include "engine/render/reference/scene_tracer.h"
#include "engine/render/renderer.h"
#include "modules/reflections/captures.h"

namespace gloam {

/// Called with the number of finished captures and of all captures.
using BakeProgress = std::function<void(std::size_t done, std::size_t total)>;

struct BakeSettings {
  JobExecutor* executor = nullptr;   ///< must be set
  BakeProgress progress;             ///< may be empty
  std::uint32_t proxy_side = 128;    ///< texels of a proxy's image, a power of two
  std::uint32_t grid_probes = 0;     ///< most probes of a grid for diffuse light (ReflectionCaptures::grid)
  std::vector<GridProbe> grid = {};  ///< of an earlier bake, taken over if grid_probes is 0
  /// Triangles of the world as its systems left them; must be set if grid_probes > 0. It tells which places lie inside
  /// walls.
  std::function<Result<std::unique_ptr<SceneTracer>>(const World& world)> make_tracer = {};
};

/// Captures all proxies and probes of the world, in its pose at the SceneClock's time: runs the scene systems, then
/// draws frames of views with the purpose `capture`. Each frame counts as a frame of the world, and the captures depend
/// on the renderer's knobs: with lighting.indirect=probes they show surfaces in that light. A caller whose pictures
/// must not depend on a bake gives it a renderer and a world of their own, and hands the result over with
/// encode_captures() and decode_captures(). Error: an image file of a proxy cannot be read, a light is unknown, or a
/// frame failed.
[[nodiscard]] Result<ReflectionCaptures> bake_reflections(Renderer& renderer, World& world,
                                                          const BakeSettings& settings);

/// Gives each flame of the world (FlameSource) four proxies around it, as children of its node, unless the node or a
/// child of it is a fire proxy already. The importer calls it; worlds built by code call it before they are baked.
void add_flame_proxies(World& world);

/// Makes the captures those of the world, with a version that differs from the one before. The entities of the captures
/// are of this world.
void attach_captures(World& world, ReflectionCaptures captures);

/// Hash of everything that the captures of a world depend on: the meshes, materials, textures and places of static
/// instances, lights with their cookies, sky, proxies with their image files, probes, and the version of the bake. Not
/// of cameras and time, and of one knob: of animated nodes it hashes the animation and not the current pose. Reads
/// image files of proxies and cookies; a file that cannot be read counts as empty. The world's scene systems must have
/// run once. 0 is never returned.
[[nodiscard]] std::uint64_t capture_content(const World& world, IndirectSource light = IndirectSource::sky);

/// The captures as bytes. Entities are stored as positions among the world's entities of their kind (proxies, probes,
/// lights), ordered by entity index, so that another world of the same content can read them.
[[nodiscard]] std::string encode_captures(const World& world, const ReflectionCaptures& captures);
/// None if the bytes are not of encode_captures() or name an entity that the world does not have.
[[nodiscard]] std::optional<ReflectionCaptures> decode_captures(const World& world, std::string_view bytes);

/// Writes a file with the captures, their content hash and a checksum, and creates its folder. A reader sees the old
/// file or all of the new one.
[[nodiscard]] Status save_captures(const std::string& path, const World& world, const ReflectionCaptures& captures);

/// Captures of this content (capture_content()) from a file. None if there is no file; if it is damaged or of another
/// content, a line of the log says so.
[[nodiscard]] std::optional<ReflectionCaptures> load_captures(const std::string& path, const World& world,
                                                              std::uint64_t content, LogSink& log);

}  // namespace gloam

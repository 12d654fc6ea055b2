// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/core/log.h"
#include "engine/core/result.h"
#include "modules/reflections/bake.h"
#include "sandbox/console.h"
#include "sandbox/options.h"
#include "sandbox/session/session.h"

namespace gloam {

/// The captures file beside a scene file: "scenes/courtyard.captures" for "scenes/courtyard.gltf". Empty for a built-in
/// scene.
[[nodiscard]] std::string captures_beside(const std::string& scene);
/// The file of these captures in --cache-dir, for this device. Empty if there is no such folder.
[[nodiscard]] std::string cached_captures(const Session& session, const Options& options, std::uint64_t content);

/// Captures the session's proxies and probes at simulated time 0 and with the default knobs, not with the session's,
/// but for lighting.indirect. grid: BakeSettings::grid. Uses a separate renderer and world on the session's device, so
/// the session's next frame is as without it. The result's entities are of the session's world.
[[nodiscard]] Result<ReflectionCaptures> bake_scene(Session& session, const Options& options, LogSink& log,
                                                    const BakeProgress& progress = {},
                                                    std::vector<GridProbe> grid = {});

/// Gives the session's world what is baked before the first frame: ensure_captures() and ensure_particle_light().
/// console: shows progress; may be null.
[[nodiscard]] Status ensure_baked(Session& session, const Options& options, LogSink& log, Console* console = nullptr);

/// Gives the session's world its captures, if the reflections module is built and demanded: reads them from the file
/// beside the scene or from the cache, else bakes them and fills the cache. Captures of another lighting.indirect count
/// as others. Call it before the first frame, and between frames after a change of that knob. A cache that cannot be
/// written is a warning.
[[nodiscard]] Status ensure_captures(Session& session, const Options& options, LogSink& log,
                                     const BakeProgress& progress = {});

/// Shows a progress bar on a terminal unless quiet. what: "reflection captures".
[[nodiscard]] BakeProgress show_bake_progress(Console& console, bool quiet, std::string what);

}  // namespace gloam

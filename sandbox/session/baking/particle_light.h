// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>

#include "engine/core/log.h"
#include "engine/core/result.h"
#include "sandbox/options.h"
#include "sandbox/session/session.h"

namespace gloam {

/// Gives the session's world the baked light of its particle emitters, if the particles module is demanded: reads it
/// from the cache, else traces it and fills the cache. Call it before the first frame. A cache that cannot be written
/// is a warning.
[[nodiscard]] Status ensure_particle_light(Session& session, const Options& options, LogSink& log,
                                           const std::function<void(std::size_t done, std::size_t total)>& progress);

}  // namespace gloam

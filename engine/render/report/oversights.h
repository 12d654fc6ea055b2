// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "engine/core/once_log.h"
#include "engine/render/modules_in_use/module_set.h"
#include "engine/render/view_request.h"
#include "engine/render/worlds/world_slots.h"

namespace gloam {

/// Logs what has no effect in a frame as it is: components of the world, cameras of the views, and names of modules
/// that the views leave out. Logs each fault once; those of components once per world.
void warn_of_oversights(const World& world, std::span<const ViewRequest> requests, const ModuleList& modules,
                        WorldSlots& worlds, OnceLog& once, LogSink& log);

}  // namespace gloam

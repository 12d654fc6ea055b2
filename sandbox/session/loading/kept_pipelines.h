// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// Which pipelines a scene's first picture needs is known once it was drawn. The list is kept in the cache, so that
// later runs make these pipelines while the scene is loaded.
#pragma once

#include "engine/core/log.h"
#include "sandbox/options.h"
#include "sandbox/session/session.h"

namespace gloam {

/// Begins to make the pipelines that the scene's first picture has needed, with the same knobs. Does nothing if no list
/// is kept. Before the scene is loaded.
void make_kept_pipelines(Session& session, const Options& options, LogSink& log);

/// After the first picture: keeps the list of its pipelines, if it is not kept already. Does nothing without a cache;
/// if the list cannot be written, warns.
void keep_pipelines(Session& session, const Options& options, LogSink& log);

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/log.h"
#include "engine/core/result.h"
#include "sandbox/options.h"
#include "sandbox/play/start/loading_screen.h"
#include "sandbox/session/session.h"

namespace gloam {

/// Fills a session made by open_empty_session, with captures and baked light, while the window shows the progress and
/// handles events. Returns false if the user closes the window meanwhile: the window is hidden at once, and the session
/// must not be drawn.
[[nodiscard]] Result<bool> open_scene(Session& session, const Options& options, LogSink& log, Window& window,
                                      LoadingScreen& screen);

}  // namespace gloam

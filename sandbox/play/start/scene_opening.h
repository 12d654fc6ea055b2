// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "engine/core/log.h"
#include "engine/core/result.h"
#include "sandbox/options.h"
#include "sandbox/play/start/interrupts.h"
#include "sandbox/session/session.h"
#include "sandbox/window/window.h"

namespace gloam {

/// Opens a session with its scene, captures, baked light and budgets, and draws a first frame that is not shown, so
/// that all pipelines are compiled. All of this runs on another thread; meanwhile the window shows the progress by name
/// and handles events. If the user closes the window, or at a signal, the process ends at once.
/// scale: ResolutionScale::setting.
[[nodiscard]] Result<std::unique_ptr<Session>> open_in_window(Window& window, const Options& options, double scale,
                                                              const Interrupts& interrupts, LogSink& log);

}  // namespace gloam

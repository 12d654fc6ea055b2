// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "sandbox/play/input/light_controls.h"
#include "sandbox/session/session.h"
#include "sandbox/window/undo_stack.h"

namespace gloam {

/// Everything that the panel changes and Ctrl-Z takes back: knobs, lights, exposure, lens.
[[nodiscard]] Settings panel_settings(const Session& session, const LightControls& lights);
/// Sets those that are named.
void set_panel_settings(Session& session, LightControls& lights, const Settings& settings);

}  // namespace gloam

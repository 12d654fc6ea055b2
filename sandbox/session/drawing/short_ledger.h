// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "engine/core/result.h"
#include "engine/render/knobs/knobs.h"
#include "modules/accuracy/outputs.h"
#include "sandbox/options.h"
#include "sandbox/session/session.h"

namespace gloam {

/// Settings that save time in most scenes, in the order in which a short ledger measures them: the present ones at
/// smaller sizes, and with the knobs that save most turned down. Knobs of --set keep their values.
[[nodiscard]] std::vector<std::vector<KnobOverride>> usual_settings(const Options& options);

/// Measures them in a session that is ready to be drawn, in about 15 s (measure_short_ledger()). progress: called
/// before each of them; an error ends measuring.
[[nodiscard]] Result<Ledger> measure_session_shortly(
    Session& session, const Options& options,
    const std::function<Status(std::size_t done, std::size_t total)>& progress);

}  // namespace gloam

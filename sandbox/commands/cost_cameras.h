// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "engine/core/result.h"
#include "sandbox/options.h"
#include "sandbox/session/session.h"

namespace gloam {

/// Times along an animation that --path measures.
inline constexpr std::uint32_t kPathTimes = 5;

/// The options of each camera of --cameras, and of each time of --path: at least one. A usage error names the valid
/// cameras, or says that nothing moves.
[[nodiscard]] Result<std::vector<Options>> options_of_cameras(const Options& options, const Session& session);

}  // namespace gloam

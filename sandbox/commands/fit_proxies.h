// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"
#include "sandbox/commands/commands.h"

namespace gloam {

/// `gloam bake SCENE --fit-proxies N`: proposes proxies, prints the shares of reflected rays that they catch and writes
/// them as glTF nodes.
[[nodiscard]] Status run_fit_proxies(const CommandContext& context);

}  // namespace gloam

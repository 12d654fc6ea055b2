// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "sandbox/commands/commands.h"

namespace gloam {

/// cost with --list: measures the entries of the shard one after the other, each in a folder below --out. An entry that
/// fails does not stop the others; the first error is returned at the end.
[[nodiscard]] Status run_sweep(const CommandContext& context);
/// cost with --merge. Missing shards and entries are warnings.
[[nodiscard]] Status run_merge(const CommandContext& context);
/// cost of one scene.
[[nodiscard]] Status measure_scene(const CommandContext& context);

}  // namespace gloam

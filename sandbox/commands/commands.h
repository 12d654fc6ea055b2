// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "engine/core/log.h"
#include "engine/core/result.h"
#include "engine/gpu/device.h"
#include "sandbox/console.h"
#include "sandbox/options.h"

namespace gloam {

/// Input of every command. The references must outlive the call.
struct CommandContext {
  const Options& options;
  Console& console;
  LogSink& log;
  /// The device of `render`, in place of the one that --device, --validate and --cache-dir choose. Null: the command
  /// opens its own.
  std::shared_ptr<gpu::Device> device;
};

[[nodiscard]] Status run_play(const CommandContext& context);
[[nodiscard]] Status run_render(const CommandContext& context);
[[nodiscard]] Status run_inspect(const CommandContext& context);
[[nodiscard]] Status run_bake(const CommandContext& context);
[[nodiscard]] Status run_cost(const CommandContext& context);
[[nodiscard]] Status run_bench(const CommandContext& context);
[[nodiscard]] Status run_selftest_command(const CommandContext& context);
[[nodiscard]] Status run_compare(const CommandContext& context);
[[nodiscard]] Status run_knobs(const CommandContext& context);
[[nodiscard]] Status run_scenes(const CommandContext& context);

}  // namespace gloam

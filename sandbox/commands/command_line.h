// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <span>
#include <string>

#include "engine/gpu/device.h"
#include "sandbox/console.h"

namespace gloam {

/// Runs the command of these arguments (those of main, without the program's name) and returns the exit code of the
/// program. An error is printed as one line. device: as in CommandContext.
[[nodiscard]] int run_command_line(std::span<const std::string> arguments, Console& console,
                                   std::shared_ptr<gpu::Device> device = nullptr);

/// Prints failed assertions on this console from now on: standard error itself is captured while a Console exists.
/// The console must outlive the last assertion, or be replaced.
void tell_assertions(Console* console);

}  // namespace gloam

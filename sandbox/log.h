// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

#include "engine/core/log.h"
#include "engine/core/result.h"
#include "sandbox/console.h"

namespace gloam {

struct LogOptions {
  bool quiet = false;  ///< warnings do not reach the console
  std::string file;    ///< every line of every level with its time goes here; empty: nowhere
};

/// The program's log. Warnings, and faults that the engine reports before it returns an error, go to the console as
/// warnings, so that a failure stays one line. The console must outlive it. Fails when the file cannot be written.
[[nodiscard]] Result<std::unique_ptr<LogSink>> make_program_log(Console& console, const LogOptions& options);

}  // namespace gloam

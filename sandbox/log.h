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
  std::string file;    ///< log file: gets every line of every level with its time; empty: no file
};

/// Makes the program's log. Messages of level warning and error go to the console as warnings: the engine may log an
/// error before it returns one, and only the returned error is printed as the error line. The console must outlive the
/// log. Returns ErrorKind::failed if the file cannot be written.
[[nodiscard]] Result<std::unique_ptr<LogSink>> make_program_log(Console& console, const LogOptions& options);

}  // namespace gloam

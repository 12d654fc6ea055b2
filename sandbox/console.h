// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstdio>
#include <memory>
#include <string>
#include <string_view>

#include "engine/core/log.h"
#include "engine/core/result.h"

namespace gloam {

/// Standard output and standard error of the program, separate from the output of libraries. While a Console exists,
/// everything that other code writes to the two streams is captured in a temporary file, and only this class writes to
/// the real streams. Sanitizer builds capture nothing. At most one Console may exist in a process.
class Console {
 public:
  Console();
  ~Console();
  Console(const Console&) = delete;
  Console& operator=(const Console&) = delete;

  /// Writes a result to standard output, unchanged. `flush` reports a failure to write.
  void print(std::string_view text);
  /// Writes bytes to standard output (1) or standard error (2), at once, also while a Console has taken the stream.
  /// Returns false, with errno, if not all could be written.
  [[nodiscard]] static bool write_stream(int number, std::string_view bytes);
  /// Writes the line "gloam: error: MESSAGE" to standard error.
  void print_error(std::string_view message);
  /// Writes the line "gloam: warning: MESSAGE" to standard error.
  void print_warning(std::string_view message);

  /// Whether standard error is a terminal, so that a progress line can be overwritten.
  [[nodiscard]] bool shows_progress() const;
  /// Shows a progress line, which the next one or any other output replaces. An empty line removes it. Does nothing if
  /// shows_progress() is false.
  void show_progress(std::string_view line);

  /// Flushes standard output. Returns ErrorKind::failed if results could not be written (disk full, stream closed).
  [[nodiscard]] Status flush();

  /// The output of libraries captured so far; empty if nothing is captured.
  [[nodiscard]] std::string captured() const;

 private:
  std::FILE* results_ = nullptr;
  std::FILE* errors_ = nullptr;
  std::FILE* capture_ = nullptr;
  bool failed_ = false;
  std::atomic<bool> progress_ = false;  ///< a progress line is shown; atomic because jobs may print warnings
};

/// `text` as one line: each run of spaces and control characters becomes one space, and both ends are trimmed.
[[nodiscard]] std::string joined_lines(std::string_view text);

}  // namespace gloam

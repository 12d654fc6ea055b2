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

/// The program's two streams, kept apart from what libraries print: from its making to its end everything that others
/// write to standard output and standard error is captured, and only this class reaches the real ones. One at a time in
/// a process.
class Console {
 public:
  Console();
  ~Console();
  Console(const Console&) = delete;
  Console& operator=(const Console&) = delete;

  /// Results: text to standard output as it is. A failure to write is kept for `flush`.
  void print(std::string_view text);
  /// The one line "gloam: error: …" on standard error.
  void print_error(std::string_view message);
  /// A line on standard error with "gloam: warning: " in front.
  void print_warning(std::string_view message);

  /// Whether standard error is a terminal, where a line may be overwritten.
  [[nodiscard]] bool shows_progress() const;
  /// Shows a line that the next one, or any other output, replaces; an empty one takes it away. Nothing unless
  /// shows_progress.
  void show_progress(std::string_view line);

  /// Error of ErrorKind::failed when results could not be written (disk full, closed).
  [[nodiscard]] Status flush();

  /// What libraries printed so far.
  [[nodiscard]] std::string captured() const;

 private:
  std::FILE* results_ = nullptr;
  std::FILE* errors_ = nullptr;
  std::FILE* capture_ = nullptr;
  bool failed_ = false;
  std::atomic<bool> progress_ = false;  ///< a line is shown; warnings may come from jobs
};

/// `text` as one line: line breaks and other control characters become single spaces, none at the ends.
[[nodiscard]] std::string one_line(std::string_view text);

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/console.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>

namespace gloam {
namespace {

// A sanitizer writes its report to file descriptor 2: capturing would hide it.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kCapture = false;
#else
constexpr bool kCapture = true;
#endif

/// A separate stream to the current target of file descriptor `number`; null if the descriptor is closed. It does not
/// take the number of another standard stream that is closed.
std::FILE* duplicate(int number) {
  const int copy = fcntl(number, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
  return copy < 0 ? nullptr : fdopen(copy, "w");
}

/// The Console that exists.
Console* taken_by = nullptr;

void write_line(std::FILE* stream, std::string_view start, std::string_view message) {
  if (stream == nullptr) return;
  const std::string line = std::string(start) + joined_lines(message) + "\n";
  std::fwrite(line.data(), 1, line.size(), stream);
  std::fflush(stream);
}

}  // namespace

Console::Console() : results_(duplicate(STDOUT_FILENO)), errors_(duplicate(STDERR_FILENO)) {
  taken_by = this;
  if (!kCapture) return;
  capture_ = std::tmpfile();
  if (capture_ == nullptr) return;
  dup2(fileno(capture_), STDOUT_FILENO);
  dup2(fileno(capture_), STDERR_FILENO);
}

Console::~Console() {
  taken_by = nullptr;
  if (results_ != nullptr) std::fflush(results_);
  if (capture_ != nullptr) {
    std::fflush(stdout);
    if (results_ != nullptr) dup2(fileno(results_), STDOUT_FILENO);
    if (errors_ != nullptr) dup2(fileno(errors_), STDERR_FILENO);
    std::fclose(capture_);
  }
  if (results_ != nullptr) std::fclose(results_);
  if (errors_ != nullptr) std::fclose(errors_);
}

bool Console::shows_progress() const { return errors_ != nullptr && isatty(fileno(errors_)) == 1; }

void Console::show_progress(std::string_view line) {
  if (line.empty() && !progress_) return;
  if (!shows_progress()) return;
  const std::string text = "\r\x1b[K" + joined_lines(line);
  std::fwrite(text.data(), 1, text.size(), errors_);
  std::fflush(errors_);
  progress_ = !line.empty();
}

void Console::print(std::string_view text) {
  show_progress({});
  if (results_ == nullptr || std::fwrite(text.data(), 1, text.size(), results_) != text.size()) failed_ = true;
}

bool Console::write_stream(int number, std::string_view bytes) {
  std::FILE* stream = number == STDOUT_FILENO ? stdout : stderr;
  if (taken_by != nullptr) {
    taken_by->show_progress({});
    stream = number == STDOUT_FILENO ? taken_by->results_ : taken_by->errors_;
  }
  errno = EBADF;
  return stream != nullptr && std::fwrite(bytes.data(), 1, bytes.size(), stream) == bytes.size() &&
         std::fflush(stream) == 0;
}

void Console::print_error(std::string_view message) {
  show_progress({});
  if (results_ != nullptr) std::fflush(results_);
  write_line(errors_, "gloam: error: ", message);
}

void Console::print_warning(std::string_view message) {
  show_progress({});
  write_line(errors_, "gloam: warning: ", message);
}

Status Console::flush() {
  if (results_ != nullptr && std::fflush(results_) != 0) failed_ = true;
  if (failed_) return Error{ErrorKind::failed, "results cannot be written to standard output"};
  return {};
}

std::string Console::captured() const {
  std::string text;
  if (capture_ == nullptr) return text;
  std::fflush(stdout);
  char block[4096];
  off_t offset = 0;
  // pread does not move the shared file position: libraries keep writing at the end.
  for (ssize_t got = 0; (got = pread(fileno(capture_), block, sizeof(block), offset)) > 0; offset += got)
    text.append(block, static_cast<std::size_t>(got));
  return text;
}

std::string joined_lines(std::string_view text) {
  std::string line;
  bool space = false;
  for (const char c : text) {
    if (static_cast<unsigned char>(c) <= 0x20) {
      space = !line.empty();
      continue;
    }
    if (space) line += ' ';
    space = false;
    line += c;
  }
  return line;
}

}  // namespace gloam

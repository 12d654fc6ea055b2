// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <thread>

namespace gloam {

/// Ends the process at once, without destructors: work on other threads cannot be stopped, and the driver may be
/// compiling for seconds. Files are replaced as a whole, so none is left half written.
[[noreturn]] void end_process(int code);

/// A shell's code for a program that a signal has ended, less the number of the signal.
inline constexpr int kSignalExit = 128;

/// Watches for SIGINT and SIGTERM. After one of them the owner should save what is to be kept and call end_process()
/// with kSignalExit + its number. If it has not done so after 0.12 s, another thread does. At most one may exist.
class Interrupts {
 public:
  Interrupts();
  ~Interrupts();
  Interrupts(const Interrupts&) = delete;
  Interrupts& operator=(const Interrupts&) = delete;

  /// The number of the signal that has arrived; 0: none.
  [[nodiscard]] int arrived() const;

 private:
  std::jthread watch_;
};

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <csignal>
#include <string>
#include <vector>

#include "engine/core/storage/sealed_file.h"
#include "engine/gpu/vulkan_device.h"
#include "sandbox/commands/command_line.h"
#include "sandbox/console.h"

namespace {

/// Ends the program as the signal would have done, but without files that are half written.
extern "C" void end_at_signal(int number) {
  gloam::remove_unfinished_files();
  std::signal(number, SIG_DFL);
  std::raise(number);
}

/// Signals that the program was started to ignore (nohup) stay ignored.
void watch_signal(int number) {
  if (std::signal(number, end_at_signal) == SIG_IGN) std::signal(number, SIG_IGN);
}

}  // namespace

int main(int argc, char** argv) {
  gloam::gpu::separate_driver_caches();
#ifdef SIGXFSZ
  std::signal(SIGXFSZ, SIG_IGN);  // a file that grows too large (ulimit -f) is an error like a full disk
#endif
  watch_signal(SIGINT);
  watch_signal(SIGTERM);
#ifdef SIGHUP
  watch_signal(SIGHUP);
#endif
  gloam::Console console;
  gloam::tell_assertions(&console);
  const std::vector<std::string> arguments(argv + (argc > 0 ? 1 : 0), argv + argc);
  return gloam::run_command_line(arguments, console);
}

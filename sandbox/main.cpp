// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <csignal>
#include <string>
#include <vector>

#include "engine/gpu/vulkan_device.h"
#include "sandbox/commands/command_line.h"
#include "sandbox/console.h"

int main(int argc, char** argv) {
  gloam::gpu::separate_driver_caches();
#ifdef SIGXFSZ
  std::signal(SIGXFSZ, SIG_IGN);  // a file that grows too large (ulimit -f) is an error like a full disk
#endif
  gloam::Console console;
  gloam::tell_assertions(&console);
  const std::vector<std::string> arguments(argv + (argc > 0 ? 1 : 0), argv + argc);
  return gloam::run_command_line(arguments, console);
}

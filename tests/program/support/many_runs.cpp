// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
// Runs many command lines of the program in one process, on one device that keeps compiled pipelines: most of the time
// of a short `gloam render` is the compilation of its pipelines. Each line of standard input is a run: its working
// directory, the files for its standard output and standard error, and its arguments, separated by the character 0x1f.
// The answer is a line with its exit code.
#include <fcntl.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/log.h"
#include "engine/gpu/vulkan_device.h"
#include "sandbox/commands/command_line.h"
#include "sandbox/console.h"

namespace {

std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields(1);
  for (const char c : line) {
    if (c == '\x1f')
      fields.emplace_back();
    else
      fields.back() += c;
  }
  return fields;
}

/// The stream goes to this file from now on.
void redirect(int stream, const std::string& path) {
  const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
  if (file < 0 || dup2(file, stream) < 0) std::abort();
  close(file);
}

}  // namespace

int main() {
  gloam::gpu::separate_driver_caches();
  std::FILE* answers = fdopen(fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 3), "w");
  auto opened = gloam::gpu::create_vulkan_device({.retained_pipelines = 1000, .log = &gloam::null_log()});
  if (!opened || answers == nullptr) return EXIT_FAILURE;
  const std::shared_ptr<gloam::gpu::Device> device = std::move(*opened);
  for (std::string line; std::getline(std::cin, line);) {
    const std::vector<std::string> fields = fields_of(line);
    if (fields.size() < 3) return EXIT_FAILURE;
    std::filesystem::current_path(fields[0]);
    redirect(STDOUT_FILENO, fields[1]);
    redirect(STDERR_FILENO, fields[2]);
    int code = 0;
    {
      gloam::Console console;
      gloam::tell_assertions(&console);
      code = gloam::run_command_line(std::span(fields).subspan(3), console, device);
      gloam::tell_assertions(nullptr);
    }
    std::fprintf(answers, "%d\n", code);
    std::fflush(answers);
  }
  return EXIT_SUCCESS;
}

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <memory>
#include <new>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "engine/core/assert.h"
#include "engine/core/env.h"
#include "engine/gpu/vulkan_device.h"
#include "sandbox/commands/commands.h"
#include "sandbox/console.h"
#include "sandbox/log.h"
#include "sandbox/options.h"

namespace {

using gloam::Error;
using gloam::ErrorKind;
using gloam::Status;

// Prints failed assertions: standard error itself is captured while the program runs.
gloam::Console* assert_console = nullptr;

[[noreturn]] void tell_assertion(const char* /*condition*/, std::string_view sentence, const char* file, int line) {
  if (assert_console != nullptr)
    assert_console->print_error("internal: " + std::string(sentence) + " (" + file + ":" + std::to_string(line) + ")");
  std::abort();
}

int exit_code(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::failed:
      return 1;
    case ErrorKind::usage:
      return 2;
    case ErrorKind::input:
      return 3;
    case ErrorKind::no_device:
      return 4;
  }
  return 1;
}

Status run_command(const gloam::CommandContext& context) {
  switch (context.options.command) {
    case gloam::Command::play:
      return run_play(context);
    case gloam::Command::render:
      return run_render(context);
    case gloam::Command::inspect:
      return run_inspect(context);
    case gloam::Command::bake:
      return run_bake(context);
    case gloam::Command::cost:
      return run_cost(context);
    case gloam::Command::bench:
      return run_bench(context);
    case gloam::Command::knobs:
      return run_knobs(context);
    case gloam::Command::scenes:
      return run_scenes(context);
  }
  return {};
}

Status run(std::span<const std::string> arguments, gloam::Console& console) {
  if (arguments.empty()) console.print(gloam::help_text());
  const auto parsed = gloam::parse_options(arguments, "gloam " GLOAM_VERSION);
  if (!parsed) return parsed.error();
  if (const auto* text = std::get_if<gloam::PrintAndLeave>(&*parsed)) {
    console.print(text->text);
    return {};
  }
  const auto& options = std::get<gloam::Options>(*parsed);
  const std::string log_file = gloam::environment_text("GLOAM_LOG").value_or("");
  const auto log = gloam::make_program_log(console, {.quiet = options.quiet, .file = log_file});
  if (!log) return log.error();
  Status status = run_command({.options = options, .console = console, .log = **log});
  if (const std::string captured = console.captured(); !captured.empty())
    (*log)->debug("libraries printed: " + captured);
  return status;
}

Status run_guarded(std::span<const std::string> arguments, gloam::Console& console) {
  try {
    return run(arguments, console);
  } catch (const std::bad_alloc& fault) {
    const std::string reason = fault.what();
    return Error{ErrorKind::failed, reason == std::bad_alloc().what() ? "out of memory" : reason};
  } catch (const std::exception& fault) {
    return Error{ErrorKind::failed, std::string("internal: ") + fault.what()};
  }
}

}  // namespace

int main(int argc, char** argv) {
  gloam::gpu::separate_driver_caches();
#ifdef SIGXFSZ
  std::signal(SIGXFSZ, SIG_IGN);  // a file that grows too large (ulimit -f) is an error like a full disk
#endif
  gloam::Console console;
  assert_console = &console;
  gloam::set_assert_handler(&tell_assertion);
  const std::vector<std::string> arguments(argv + (argc > 0 ? 1 : 0), argv + argc);
  Status status = run_guarded(arguments, console);
  if (const Status flushed = console.flush(); status.ok() && !flushed.ok()) status = flushed;
  if (status.ok()) return EXIT_SUCCESS;
  console.print_error(status.error().message);
  return exit_code(status.error().kind);
}

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/commands/command_line.h"

#include <cstdlib>
#include <exception>
#include <new>
#include <string_view>
#include <utility>
#include <variant>

#include "engine/core/assert.h"
#include "engine/core/env.h"
#include "sandbox/commands/commands.h"
#include "sandbox/log.h"
#include "sandbox/options.h"

namespace gloam {
namespace {

Console* assert_console = nullptr;

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

Status run_command(const CommandContext& context) {
  switch (context.options.command) {
    case Command::play:
      return run_play(context);
    case Command::render:
      return run_render(context);
    case Command::inspect:
      return run_inspect(context);
    case Command::bake:
      return run_bake(context);
    case Command::cost:
      return run_cost(context);
    case Command::bench:
      return run_bench(context);
    case Command::selftest:
      return run_selftest_command(context);
    case Command::compare:
      return run_compare(context);
    case Command::knobs:
      return run_knobs(context);
    case Command::scenes:
      return run_scenes(context);
  }
  return {};
}

Status run(std::span<const std::string> arguments, Console& console, std::shared_ptr<gpu::Device> device) {
  if (arguments.empty()) console.print(help_text());
  const auto parsed = parse_options(arguments, "gloam " GLOAM_VERSION);
  if (!parsed) return parsed.error();
  if (const auto* text = std::get_if<PrintAndLeave>(&*parsed)) {
    console.print(text->text);
    return {};
  }
  const auto& options = std::get<Options>(*parsed);
  const std::string log_file = environment_text("GLOAM_LOG").value_or("");
  const auto log = make_program_log(console, {.quiet = options.quiet, .file = log_file});
  if (!log) return log.error();
  if (options.seed_given) {
    (*log)->warning("--seed changes nothing: no effect of this version is random (gloam.grass.seed seeds grass)");
  }
  Status status = run_command({.options = options, .console = console, .log = **log, .device = std::move(device)});
  if (const std::string captured = console.captured(); !captured.empty())
    (*log)->debug("libraries printed: " + captured);
  return status;
}

Status run_guarded(std::span<const std::string> arguments, Console& console, std::shared_ptr<gpu::Device> device) {
  try {
    return run(arguments, console, std::move(device));
  } catch (const std::bad_alloc& fault) {
    const std::string reason = fault.what();
    return Error{ErrorKind::failed, reason == std::bad_alloc().what() ? "out of memory" : reason};
  } catch (const std::exception& fault) {
    return Error{ErrorKind::failed, std::string("internal: ") + fault.what()};
  }
}

}  // namespace

int run_command_line(std::span<const std::string> arguments, Console& console, std::shared_ptr<gpu::Device> device) {
  Status status = run_guarded(arguments, console, std::move(device));
  if (const Status flushed = console.flush(); status.ok() && !flushed.ok()) status = flushed;
  if (status.ok()) return EXIT_SUCCESS;
  console.print_error(status.error().message);
  return exit_code(status.error().kind);
}

void tell_assertions(Console* console) {
  assert_console = console;
  set_assert_handler(&tell_assertion);
}

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "tests/fuzz/command_line_format.h"

#include <charconv>
#include <cmath>
#include <string>
#include <vector>

#include "sandbox/options.h"

namespace gloam::fuzz {
namespace {

using Arguments = std::vector<std::string>;

std::string number_text(double number) {
  char text[32];
  return std::string(text, std::to_chars(text, text + sizeof(text), number).ptr);
}

constexpr const char* kCommands[] = {"play",  "render",   "inspect", "bake",   "cost",
                                     "bench", "selftest", "compare", "scenes", "knobs"};

/// A command line for the parsed options: what all commands share, and what is given to one of them.
Arguments written(const Options& options) {
  Arguments arguments = {kCommands[static_cast<std::size_t>(options.command)]};
  const auto add = [&](const char* name, const std::string& value) {
    if (!value.empty()) arguments.push_back(std::string(name) + "=" + value);
  };
  add("--size", std::to_string(options.width) + "x" + std::to_string(options.height));
  if (options.frames > 0) add("--frames", std::to_string(options.frames));
  add("--time", number_text(options.time_s));
  if (options.fixed_step) add("--dt", number_text(options.dt_s));
  if (options.seed_given) add("--seed", std::to_string(options.seed));
  add("--threads", std::to_string(options.threads));
  if (options.pick) add("--pick", std::to_string(options.pick->x) + "," + std::to_string(options.pick->y));
  if (options.budget_ms) add("--budget", number_text(*options.budget_ms) + "ms");
  for (const EffectBudget& budget : options.effect_budgets)
    add("--budget", budget.effect + "=" + number_text(budget.ms));
  for (const std::string& assignment : options.assignments) add("--set", assignment);
  for (const auto& [name, value] : {std::pair{"--camera", &options.camera},
                                    {"--view", &options.view},
                                    {"--out", &options.out},
                                    {"--stats", &options.stats},
                                    {"--trace", &options.trace},
                                    {"--device", &options.device},
                                    {"--animation", &options.animation},
                                    {"--config", &options.config},
                                    {"--lights", &options.lights},
                                    {"--cache-dir", &options.cache_dir},
                                    {"--ledger", &options.ledger}})
    add(name, *value);
  if (options.validate) arguments.push_back("--validate");
  if (options.quiet) arguments.push_back("--quiet");
  if (options.list && (options.command == Command::bench || options.command == Command::selftest))
    arguments.push_back("--list");
  if (options.command == Command::cost) {
    for (const auto& [name, value] :
         {std::pair{"--knobs", &options.knobs}, {"--cameras", &options.cameras}, {"--list", &options.scene_list}})
      add(name, *value);
    if (!options.scene_list.empty())
      add("--shard", std::to_string(options.shard.number) + "/" + std::to_string(options.shard.count));
    if (options.minutes) add("--minutes", number_text(*options.minutes));
    if (options.points) add("--points", std::to_string(*options.points));
    for (const std::string& folder : options.merge) add("--merge", folder);
  }
  if (options.command == Command::render) add("--in-flight", std::to_string(options.in_flight));
  if (options.command == Command::bake && options.fit_proxies > 0)
    add("--fit-proxies", std::to_string(options.fit_proxies));
  if (options.command == Command::compare) add("--most", number_text(options.most_flip));
  if (options.command == Command::bench) add("--scene", options.scene);
  // An empty name is one, and no file has it.
  const bool needs_scene =
      options.command == Command::render || options.command == Command::inspect || options.command == Command::bake;
  const bool takes_scene = options.command == Command::play || options.command == Command::cost;
  arguments.push_back("--");
  if (needs_scene || (takes_scene && !options.scene.empty())) arguments.push_back(options.scene);
  for (const std::string& name : options.names) arguments.push_back(name);
  return arguments;
}

std::string range_fault(const Options& o) {
  if (o.width < 1 || o.width > kMaxSize || o.height < 1 || o.height > kMaxSize) return "a size is out of range";
  if (o.frames < 1 && o.command != Command::play) return "there are no frames";
  if (!std::isfinite(o.time_s) || !std::isfinite(o.dt_s) || o.dt_s < 0.0) return "a time is out of range";
  if (o.threads > 1024) return "there are too many threads";
  if (o.scale != 0.0 && !(o.scale >= 0.25 && o.scale <= 1.0)) return "the scale is out of range";
  if (o.in_flight < 1 || o.in_flight > 2) return "frames in flight are out of range";
  if (o.pick && (o.pick->x >= o.width || o.pick->y >= o.height)) return "the picked pixel is outside";
  if (o.budget_ms && !(*o.budget_ms > 0.0 && *o.budget_ms <= 1e6)) return "a budget is out of range";
  for (const EffectBudget& budget : o.effect_budgets)
    if (budget.effect.empty() || !(budget.ms > 0.0 && budget.ms <= 1e6)) return "an effect's budget is out of range";
  if (o.shard.number < 1 || o.shard.number > o.shard.count) return "the shard is out of range";
  if (o.minutes && !(*o.minutes > 0.0 && *o.minutes <= 1e6)) return "minutes are out of range";
  if (o.grid_probes > 256) return "there are too many probes";
  if (!(o.most_flip >= 0.0 && o.most_flip <= 1.0)) return "the largest error is out of range";
  for (const std::string& assignment : o.assignments)
    if (assignment.find('=') == std::string::npos) return "an assignment has no value";
  return {};
}

/// Accepted options are in their ranges, and the same when they are written and read again.
Outcome run_command_line(Input input) {
  const Arguments arguments = lines_of(text_of(input));
  const auto parsed = parse_options(arguments, "gloam 1");
  if (!parsed) return refused(parsed.error(), ErrorKind::usage);
  if (std::holds_alternative<PrintAndLeave>(*parsed)) return accepted();
  const auto& options = std::get<Options>(*parsed);
  if (std::string fault = range_fault(options); !fault.empty()) return broken(std::move(fault));
  const Arguments once = written(options);
  const auto again = parse_options(once, "gloam 1");
  std::string line;
  for (const std::string& argument : once) line += argument + "\n";
  if (!again) return broken("is refused when it is written again: " + again.error().message + "\n" + line);
  if (written(std::get<Options>(*again)) != once) return broken("is another one when it is written again:\n" + line);
  return accepted();
}

std::vector<Bytes> command_lines() {
  std::vector<Bytes> all;
  for (const char* line :
       {"render\nbuiltin:dusk\n--size\n320x180\n--camera\nstreet\n--out\na.png\n--pick\n3,4\n--frames\n2",
        "render\nscene.gltf\n--budget\n33ms\n--budget\nreflections=5ms\n--ledger\nd\n--in-flight\n2\n--validate",
        "play\n--scale\n0.5\n--dt\n0.01\n--set\nshadows.filter=hard\n--set\nviews.scale=0.5\n--lights\nl.json",
        "inspect\na.glb\n--json\n--animation\nwalk\n--seed\n18446744073709551615",
        "bake\na.glb\n--fit-proxies\n4\n--probes\n64\n--beside",
        "cost\na.glb\n--out\nd\n--knobs\nlights.*,shadows.filter\n--cameras\na,b\n--path\n--points\n10\n--minutes\n2.5",
        "cost\n--list\nl.txt\n--shard\n2/3\n--out\nd\n--quick", "cost\n--merge\na\n--merge\nb\n--out\nd",
        "bench\necs\njobs.empty\n--json\nb.json\n--strict\n--scene\na.glb", "bench\n--list",
        "selftest\n--only\nkernel.*\n--quick\n--out\nd", "compare\na.png\nb.png\n--most\n0.01", "scenes\n--quiet",
        "knobs\n--json\n--config\nk.json\n--view\nshadow:lamp\n--threads\n3\n--cache-dir\nc\n--time\n-1e3", "--version",
        "render\n--help"})
    all.push_back(bytes_of(line));
  return all;
}

std::vector<std::string> command_words() {
  std::vector<std::string> words(std::begin(kCommands), std::end(kCommands));
  for (const char* word :
       {"--size",   "--camera",  "--frames",    "--time",     "--dt",     "--seed",      "--set",    "--config",
        "--lights", "--view",    "--pick",      "--out",      "--stats",  "--trace",     "--device", "--threads",
        "--budget", "--ledger",  "--cache-dir", "--validate", "--quiet",  "--knobs",     "--quick",  "--list",
        "--shard",  "--merge",   "--points",    "--minutes",  "--path",   "--json",      "--scene",  "--strict",
        "--only",   "--shaders", "--most",      "--probes",   "--script", "--in-flight", "--scale",  "--",
        "-h",       "--help",    "--version",   "\n",         "=",        "1x1",         "16385x1",  "nan",
        "inf",      "-1",        "+1",          "0x10",       "010",      "1/0",         "builtin:", "/dev/stdout",
        "ms",       "5ms",       "[a]",         "{}",         "@file",    "%",           "\"a b\""})
    words.emplace_back(word);
  return words;
}

}  // namespace

Format command_line_format() { return {"command line", run_command_line, command_lines, command_words}; }

}  // namespace gloam::fuzz

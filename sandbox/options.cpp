// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/options.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "engine/core/env.h"
#include "engine/core/text/nearest_name.h"
#include "engine/core/text/plain_text.h"

namespace gloam {
namespace {

/// Parses exactly two unsigned numbers with `separator` between them. Returns false for any other text.
bool parse_pair(const std::string& text, char separator, std::uint32_t& first, std::uint32_t& second) {
  const char* const end = text.data() + text.size();
  const auto left = std::from_chars(text.data(), end, first);
  if (left.ec != std::errc() || left.ptr == end || *left.ptr != separator) return false;
  const auto right = std::from_chars(left.ptr + 1, end, second);
  return right.ec == std::errc() && right.ptr == end;
}

struct RawTexts {
  std::string size;
  std::string pick;
  std::optional<std::string> in_flight;
  std::optional<std::string> scale;
  std::optional<std::string> time;
  std::optional<std::string> dt;
  std::optional<std::string> seed;
  std::string changed_shaders;
  std::vector<std::string> budgets;
  std::optional<std::string> shard;
  std::optional<std::string> minutes;
  bool version = false;
};

void add_frame_options(CLI::App& app, Options& options, RawTexts& raw) {
  app.add_option("--size", raw.size, "Size of the picture in pixels (default 1280x720)")->type_name("WxH");
  app.add_option("--camera", options.camera, "Camera of the scene; default: the first, else one fitted to the scene")
      ->type_name("NAME");
  app.add_option("--frames", options.frames, "Number of frames (default 1; play: until the window is closed)")
      ->type_name("N");
  app.add_option("--time", raw.time, "Simulated time of the first frame (default 0)")->type_name("SECONDS");
  app.add_option("--dt", raw.dt, "Simulated time from frame to frame (default 1/60)")->type_name("SECONDS");
  app.add_option("--seed", raw.seed,
                 "Seed of random effects (default 1); this version has none, says so, and pictures do not depend on it")
      ->type_name("N");
  app.add_option("--set", options.assignments, "Set a knob; may be given several times")
      ->type_name("KNOB=VALUE")
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  app.add_option("--config", options.config, "Set knobs from a JSON object {\"KNOB\": VALUE}; --set overrides it")
      ->type_name("FILE");
  app.add_option("--lights", options.lights,
                 "Change lights of the scene by a JSON file, as the panel of play saves it (docs/play.md)")
      ->type_name("FILE");
  app.add_option("--view", options.view, "Visualizer to show instead of the lit picture")->type_name("VISUALIZER");
  app.add_option("--pick", raw.pick, "Print details about a pixel: depth, lights, lists, shadows")->type_name("X,Y");
  app.add_option("--animation", options.animation, "Clip to play if several clips animate the same property")
      ->type_name("NAME");
}

void add_machine_options(CLI::App& app, Options& options, RawTexts& raw) {
  app.add_option(
         "--out", options.out,
         "Picture to write: .png, or .exr for linear light, or with --view for its values (default out/<scene>.png); "
         "render --frames N: frame_%04d.png writes all frames; cost: folder of the ledger; bench governor: folder for "
         "the times of all frames; selftest: folder of the report; bake: folder for pictures of the captures")
      ->type_name("FILE");
  app.add_option("--stats", options.stats, "Write times, memory and counters as JSON")->type_name("FILE");
  app.add_option("--trace", options.trace, "Write a Chrome trace of systems and passes")->type_name("FILE");
  app.add_option("--device", options.device, "Vulkan device: auto, cpu, gpu, or part of its name")->type_name("DEVICE");
  app.add_option("--threads", options.threads, "Number of job threads (default 0: one per core)")->type_name("N");
  app.add_option("--budget", raw.budgets,
                 "Keep frames within a time, for example 33ms, or the passes of one effect, for example "
                 "reflections=5ms, by moving along the settings of --ledger; may be given several times; knobs of "
                 "--set keep their values (play, render, bench governor)")
      ->type_name("[EFFECT=]TIME")
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  app.add_option(
         "--ledger", options.ledger,
         "The ledger of gloam cost for --budget: its folder, or its ledger.json; default: SCENE.ledger.json beside "
         "the scene, or the last one of the scene on this device; play measures a short one if there is none")
      ->type_name("FILE");
  app.add_option("--cache-dir", options.cache_dir, "Directory for compiled pipelines and captures, kept between runs")
      ->type_name("DIR");
  app.add_flag("--validate", options.validate,
               "Turn on Vulkan validation with synchronization checks; any message makes the run fail");
  app.add_flag("--quiet", options.quiet, "Print only errors and requested output");
}

constexpr const char* kSceneText = "A .gltf or .glb file, or builtin:NAME";

void add_cost_options(CLI::App& cost, Options& options, RawTexts& raw) {
  cost.add_option("SCENE", options.scene, kSceneText);
  cost.add_option("--knobs", options.knobs, "Measure only these knobs, comma-separated; * stands for any characters")
      ->type_name("A,B");
  cost.add_flag("--quick", options.quick, "Fewer repetitions, and 320x180 without --size");
  cost.add_option("--cameras", options.cameras,
                  "Measure several cameras, comma-separated: the ledger has the worst of them, and each camera's rows")
      ->type_name("A,B");
  cost.add_flag("--path", options.path,
                "Measure each camera at 5 times, evenly over the scene's longest animation, or, without animations, 5 "
                "positions on a path through its cameras (those of --cameras): the ledger has the worst");
  cost.add_option("--list", options.scene_list,
                  "Measure the scenes of a file instead of SCENE: one a line with options of its own; paths are "
                  "relative to the file")
      ->type_name("FILE");
  cost.add_option("--shard", raw.shard, "With --list: measure only entries I, I+N, I+2N… (default 1/1: all)")
      ->type_name("I/N");
  cost.add_option("--merge", options.merge, "Write one table and one page of the ledgers in these folders of --list")
      ->type_name("DIR");
  cost.add_option("--points", options.points,
                  "Combinations of values to measure, in all cameras, with the default and the exact setting; 0: none; "
                  "default: 24, or 10 with --quick")
      ->type_name("N");
  cost.add_option("--minutes", raw.minutes,
                  "About how long to measure: values get fewer frames, at least 6 pairs each, and wider intervals "
                  "(default 9 with --quick, else no limit)")
      ->type_name("N");
}

struct CommandApp {
  Command command;
  CLI::App* app;
};

void add_bench_options(CLI::App& bench, Options& options) {
  bench.add_option("NAME", options.names, "Benchmarks to run: the id NAME, or all ids that begin with NAME and a dot");
  bench.add_option("--scene", options.scene, kSceneText)->type_name("SCENE");
  bench.add_option("--json", options.json_file, "Write the rows as JSON")->type_name("FILE");
  bench.add_flag("--list", options.list, "List the ids");
  bench.add_flag("--strict", options.strict, "Fail if a figure misses its bar");
  bench.footer(
      "jobs.empty is one batch: 100,000 jobs that exist already, in one call. jobs.spawn creates, runs and destroys\n"
      "100,000 separate jobs on two workers. Every row carries a hash of its result, except rows that quote a figure\n"
      "from a paper. If a row fails, the rows before it are still written.");
}

std::vector<CommandApp> add_commands(CLI::App& root, Options& options, RawTexts& raw) {
  std::vector<CommandApp> commands;
  const auto add = [&](Command command, const char* name, const char* what) {
    CLI::App* app = root.add_subcommand(name, what);
    add_frame_options(*app, options, raw);
    add_machine_options(*app, options, raw);
    commands.push_back({command, app});
    return app;
  };
  CLI::App* play = add(Command::play, "play",
                       "Open a window. Sets lighting.antialiasing=smaa, views.range=fit and "
                       "reflections.recapture=budget; --config and --set override them");
  play->add_option("SCENE", options.scene, kSceneText);
  play->add_option("--scale", raw.scale,
                   "Share of the window's width and height that is drawn: auto (default; 1 with --stats or --trace) "
                   "keeps the picture fluent, or a number in 0.25…1")
      ->type_name("SCALE");
  options.shaders = GLOAM_SOURCE_ROOT;
  play->add_option("--shaders", options.shaders,
                   "Source tree whose changed shaders are compiled while the program runs; default: the one that the "
                   "program was built from, if it is there")
      ->type_name("FOLDER");
  // For tests: see sandbox/window/input_script.h.
  play->add_option("--script", options.script)->group("");
  CLI::App* render = add(Command::render, "render", "Render without a window");
  render->add_option("SCENE", options.scene, kSceneText)->required();
  render
      ->add_option("--in-flight", raw.in_flight,
                   "Frames in flight: 1 waits for each frame (default), 2 draws without a pause between frames")
      ->type_name("N");
  CLI::App* inspect = add(Command::inspect, "inspect", "Print a scene's contents, the effects it needs, and why");
  inspect->add_option("SCENE", options.scene, kSceneText)->required();
  inspect->add_flag("--json", options.json, "Print JSON");
  CLI::App* bake = add(Command::bake, "bake", "Capture reflection proxies and probes, and keep them");
  bake->add_option("SCENE", options.scene, kSceneText)->required();
  bake->add_option("--fit-proxies", options.fit_proxies,
                   "Fit at most N proxies to the scene and write them as glTF nodes (default out/<scene>.proxies.json)")
      ->type_name("N");
  bake->add_option("--probes", options.grid_probes,
                   "Capture diffuse light at up to N places in a grid, too, for lighting.indirect=probes in a scene "
                   "without probes (1 to 256)")
      ->type_name("N")
      ->check(CLI::Range(1, 256));
  bake->add_flag("--beside", options.beside, "Write the captures beside the scene file, not to the cache");
  add_cost_options(*add(Command::cost, "cost", "Measure error and time of each knob's values. Sets shadows.reuse=off"),
                   options, raw);
  add_bench_options(
      *add(Command::bench, "bench", "Run benchmarks: the papers' tables and the CPU systems. Sets shadows.reuse=off"),
      options);
  CLI::App* selftest =
      add(Command::selftest, "selftest", "Check that the mathematics holds on this device, and how far");
  selftest->add_flag("--quick", options.quick, "Fewer checks and cases: up to a minute on two cores");
  CLI::Option* list = selftest->add_flag("--list", options.list, "List the checks");
  selftest->add_flag("--markdown", options.markdown, "With --list: print the table of docs/limits.md")->needs(list);
  selftest->add_option("--only", options.only, "Run only these checks; * stands for any characters")
      ->type_name("PATTERN");
  selftest
      ->add_option("--shaders", raw.changed_shaders,
                   "Source tree whose shaders, where they differ from those of the program's own tree, are tested in "
                   "place of the program's")
      ->type_name("FOLDER");
  CLI::App* compare = add(Command::compare, "compare", "Print how much a picture differs from another one");
  compare->add_option("PICTURES", options.names, "The picture and its reference: two PNG or JPEG files of one size")
      ->required()
      ->expected(2);
  compare->add_option("--most", options.most_flip, "Fail if the mean of FLIP is above this")
      ->type_name("FLIP")
      ->check(CLI::Range(0.0, 1.0));
  CLI::App* knobs = add(Command::knobs, "knobs", "List the knobs with their values, units and meanings");
  CLI::Option* json = knobs->add_flag("--json", options.json, "Print JSON");
  knobs->add_flag("--markdown", options.markdown, "Print the page docs/knobs.md: the defaults")->excludes(json);
  add(Command::scenes, "scenes", "List the built-in scenes and the effect each shows");
  return commands;
}

/// Arguments may hold any bytes.
Error usage(std::string_view message) {
  constexpr std::size_t kMostBytes = 2000;
  return {ErrorKind::usage, one_line(message, kMostBytes)};
}

Status read_scale(const std::string& text, double& scale) {
  if (text == "auto") {
    scale = 0.0;
    return {};
  }
  const char* const end = text.data() + text.size();
  const auto read = std::from_chars(text.data(), end, scale);
  if (read.ec == std::errc() && read.ptr == end && scale >= 0.25 && scale <= 1.0) return {};
  return usage("--scale wants auto or a number in 0.25…1, not '" + text + "'");
}

/// A decimal point is a point in every locale.
Status read_seconds(const char* option, std::string_view text, double& seconds) {
  if (text.starts_with('+')) text.remove_prefix(1);
  const char* const end = text.data() + text.size();
  const auto read = std::from_chars(text.data(), end, seconds);
  if (read.ec == std::errc() && read.ptr == end) return {};
  return usage(std::string(option) + " wants a finite number of seconds, not '" + std::string(text) + "'");
}

Status read_minutes(std::string_view text, std::optional<double>& minutes) {
  double number = 0.0;
  const char* const end = text.data() + text.size();
  const auto read = std::from_chars(text.data(), end, number);
  if (read.ec != std::errc() || read.ptr != end || !(number > 0.0 && number <= 1e6))
    return usage("--minutes wants a number above 0 and up to 1000000, not '" + std::string(text) + "'");
  minutes = number;
  return {};
}

/// CLI11 would wrap numbers below 0 and clamp those that are too large.
Status read_seed(std::string_view text, std::uint64_t& seed) {
  const char* const end = text.data() + text.size();
  const auto read = std::from_chars(text.data(), end, seed);
  if (read.ec == std::errc() && read.ptr == end) return {};
  return usage("--seed wants a whole number in 0…18446744073709551615, not '" + std::string(text) + "'");
}

Result<double> read_budget_ms(std::string_view text) {
  std::string_view digits = text;
  if (digits.ends_with("ms")) digits.remove_suffix(2);
  double number = 0.0;
  const char* const end = digits.data() + digits.size();
  const auto read = std::from_chars(digits.data(), end, number);
  if (read.ec != std::errc() || read.ptr != end || !(number > 0.0 && number <= 1e6))
    return usage("--budget wants a time above 0 and up to 1000000 ms, such as 33ms, not '" + std::string(text) + "'");
  return number;
}

Status read_budget(std::string_view text, Options& options) {
  const std::size_t equals = text.find('=');
  const auto ms = read_budget_ms(equals == std::string_view::npos ? text : text.substr(equals + 1));
  if (!ms) return ms.error();
  if (equals == std::string_view::npos) {
    if (options.budget_ms) return usage("--budget gives frames two times");
    if (options.scale_given) return usage("--budget chooses the scale: leave --scale out");
    options.budget_ms = *ms;
    return {};
  }
  const std::string effect(text.substr(0, equals));
  if (effect.empty()) return usage("--budget wants TIME or EFFECT=TIME, not '" + std::string(text) + "'");
  if (std::ranges::find(options.effect_budgets, effect, &EffectBudget::effect) != options.effect_budgets.end())
    return usage("--budget gives " + effect + " two times");
  options.effect_budgets.push_back({effect, *ms});
  return {};
}

Status read_budgets(const std::vector<std::string>& texts, Options& options) {
  const bool steered =
      options.command == Command::play || options.command == Command::render || options.command == Command::bench;
  if (!texts.empty() && !steered) return usage("--budget is of play, render and bench");
  for (const std::string& text : texts) GLOAM_TRY(read_budget(text, options));
  if (texts.empty() && !options.ledger.empty() && options.command != Command::bench)
    return usage("--ledger needs --budget");
  return {};
}

Status read_shard(const std::string& text, Shard& shard) {
  const bool read = parse_pair(text, '/', shard.number, shard.count);
  if (read && shard.number >= 1 && shard.number <= shard.count) return {};
  return usage("--shard wants I/N with I in 1…N, not '" + text + "'");
}

Status check_texts(Options& options, const RawTexts& raw) {
  if (!raw.size.empty()) {
    const bool read = parse_pair(raw.size, 'x', options.width, options.height);
    if (!read || options.width < 1 || options.height < 1 || options.width > kMaxSize || options.height > kMaxSize)
      return usage("--size wants WxH with numbers in 1…" + std::to_string(kMaxSize) + ", not '" + raw.size + "'");
  }
  options.size_given = !raw.size.empty();
  options.scale_given = raw.scale.has_value();
  if (raw.time) GLOAM_TRY(read_seconds("--time", *raw.time, options.time_s));
  if (raw.dt) GLOAM_TRY(read_seconds("--dt", *raw.dt, options.dt_s));
  options.seed_given = raw.seed.has_value();
  if (raw.seed) GLOAM_TRY(read_seed(*raw.seed, options.seed));
  if (raw.shard) {
    if (options.scene_list.empty()) return usage("--shard needs --list FILE");
    GLOAM_TRY(read_shard(*raw.shard, options.shard));
  }
  GLOAM_TRY(read_budgets(raw.budgets, options));
  if (raw.minutes) GLOAM_TRY(read_minutes(*raw.minutes, options.minutes));
  if (raw.scale) GLOAM_TRY(read_scale(*raw.scale, options.scale));
  if (raw.in_flight) {
    if (raw.in_flight != "1" && raw.in_flight != "2")
      return usage("--in-flight wants 1 or 2, not '" + *raw.in_flight + "'");
    options.in_flight = raw.in_flight == "1" ? 1 : 2;
  }
  if (!raw.pick.empty()) {
    PixelPosition pixel;
    if (!parse_pair(raw.pick, ',', pixel.x, pixel.y))
      return usage("--pick wants X,Y in pixels, not '" + raw.pick + "'");
    if (pixel.x >= options.width || pixel.y >= options.height)
      return usage("--pick " + raw.pick + " lies outside the picture of " + std::to_string(options.width) + "x" +
                   std::to_string(options.height));
    options.pick = pixel;
  }
  return {};
}

/// A standard stream receives a PNG.
bool names_a_picture(const std::string& path) {
  return path.ends_with(".png") || path.ends_with(".exr") || path == "/dev/stdout" || path == "/dev/stderr";
}

Status check_cost(const Options& options) {
  if (options.out.empty()) return usage("cost needs --out DIR");
  const int sources = int{!options.scene.empty()} + int{!options.scene_list.empty()} + int{!options.merge.empty()};
  if (!options.cameras.empty() && !options.camera.empty()) return usage("cost takes --camera or --cameras, not both");
  return sources == 1 ? Status() : usage("cost needs one of SCENE, --list FILE and --merge DIR…");
}

Status check_values(const Options& options) {
  if (options.frames < 1 && options.command != Command::play) return usage("--frames wants a number of at least 1");
  if (!std::isfinite(options.time_s)) return usage("--time wants a finite number of seconds");
  if (!std::isfinite(options.dt_s) || options.dt_s < 0.0)
    return usage("--dt wants a finite number of seconds, 0 or more");
  if (options.threads > 1024) return usage("--threads wants a number in 0…1024");
  for (const std::string& assignment : options.assignments) {
    if (assignment.find('=') == std::string::npos) return usage("--set wants KNOB=VALUE, not '" + assignment + "'");
  }
  const bool writes_picture = options.command == Command::render || options.command == Command::play;
  if (writes_picture && !options.out.empty() && !names_a_picture(options.out))
    return usage("--out wants a name that ends in .png or .exr, not '" + options.out + "'");
  if (options.command == Command::cost) return check_cost(options);
  if (options.command == Command::bench && options.names.empty() && !options.list)
    return usage("bench needs a NAME, or --list");
  return {};
}

std::string default_cache_directory() {
  if (const auto cache = environment_text("XDG_CACHE_HOME")) return *cache + "/gloam";
  if (const auto home = environment_text("HOME")) return *home + "/.cache/gloam";
  return {};
}

std::unique_ptr<CLI::App> make_app(Options& options, RawTexts& raw, std::vector<CommandApp>& commands,
                                   RepeatedOptions repeated = RepeatedOptions::error) {
  auto app = std::make_unique<CLI::App>("Many lights, soft shadows, wet reflections, moving grass", "gloam");
  if (repeated == RepeatedOptions::last) app->option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
  app->add_flag("--version", raw.version, "Print the version");
  commands = add_commands(*app, options, raw);
  return app;
}

/// The command's given options as arguments, without those that say what a sweep does.
std::vector<std::string> shared_arguments(const CLI::App& command) {
  constexpr std::array kOfTheSweep = {"--list", "--shard", "--merge", "--out"};
  std::vector<std::string> arguments;
  for (const CLI::Option* option : command.get_options()) {
    const std::string name = option->get_name();
    if (option->count() == 0 || !name.starts_with("--") || std::ranges::find(kOfTheSweep, name) != kOfTheSweep.end())
      continue;
    for (const std::string& value : option->results()) {
      arguments.push_back(name);
      if (option->get_items_expected_max() > 0) arguments.push_back(value);
    }
  }
  return arguments;
}

/// Returns ErrorKind::usage if the first argument is neither an option nor a command.
Status check_command(std::span<const std::string> arguments, const std::vector<CommandApp>& commands) {
  if (arguments.empty() || arguments.front().starts_with('-')) return {};
  const std::string& wanted = arguments.front();
  std::vector<std::string> names;
  for (const CommandApp& command : commands) {
    if (command.app->get_name() == wanted) return {};
    names.push_back(command.app->get_name());
  }
  return usage("unknown command '" + wanted + "'; " + valid_names(wanted, names));
}

}  // namespace

std::string help_text() {
  Options options;
  RawTexts raw;
  std::vector<CommandApp> commands;
  return make_app(options, raw, commands)->help();
}

Result<std::variant<Options, PrintAndLeave>> parse_options(std::span<const std::string> arguments,
                                                           const std::string& version, RepeatedOptions repeated) {
  using Outcome = std::variant<Options, PrintAndLeave>;
  Options options;
  RawTexts raw;
  std::vector<CommandApp> commands;
  const std::unique_ptr<CLI::App> app = make_app(options, raw, commands, repeated);
  GLOAM_TRY(check_command(arguments, commands));
  try {
    app->parse(std::vector<std::string>(arguments.rbegin(), arguments.rend()));
  } catch (const CLI::CallForHelp&) {
    return Outcome(PrintAndLeave{app->help()});
  } catch (const CLI::ParseError& error) {
    return usage(error.what());
  }
  if (raw.version) return Outcome(PrintAndLeave{version + "\n"});

  const CLI::App* chosen = nullptr;
  for (const CommandApp& candidate : commands) {
    if (!candidate.app->parsed()) continue;
    if (chosen != nullptr)
      return usage("one command at a time: " + chosen->get_name() + " or " + candidate.app->get_name());
    chosen = candidate.app;
    options.command = candidate.command;
  }
  if (chosen == nullptr)
    return usage("a command is needed: play, render, inspect, bake, cost, bench, selftest, compare, scenes or knobs");
  if (options.command == Command::play && chosen->count("--frames") == 0) options.frames = 0;
  if (options.command == Command::play && !(options.stats.empty() && options.trace.empty())) options.scale = 1.0;
  options.fixed_step = options.command != Command::play || chosen->count("--dt") > 0;
  if (chosen->count("--cache-dir") == 0) options.cache_dir = default_cache_directory();
  if (options.scene.empty() && (options.command == Command::play || options.command == Command::bench)) {
    options.scene = options.command == Command::play ? "builtin:dusk" : "builtin:lanterns";
    options.scene_is_default = true;
  }
  if (!options.scene_list.empty()) options.shared_arguments = shared_arguments(*chosen);
  if (options.command == Command::selftest) options.shaders = raw.changed_shaders;
  GLOAM_TRY(check_texts(options, raw));
  GLOAM_TRY(check_values(options));
  return Outcome(std::move(options));
}

}  // namespace gloam

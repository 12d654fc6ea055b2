// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/system/process.h"
#include "engine/core/text/formatted.h"
#include "engine/render/draws/levels.h"
#include "engine/render/kept_frames/kept_frames.h"
#include "engine/render/scene/scene_triangles.h"
#include "engine/render/views/renderer_knobs.h"
#include "modules/accuracy/module.h"
#include "modules/accuracy/outputs.h"
#include "modules/module_list/module_list.h"
#include "sandbox/commands/commands.h"
#include "sandbox/commands/cost_cameras.h"
#include "sandbox/commands/sweep.h"
#include "sandbox/output/file_io.h"
#include "sandbox/output/identity.h"
#include "sandbox/output/pictures/picture_folder.h"
#include "sandbox/output/progress_bar.h"
#include "sandbox/output/time_left.h"
#include "sandbox/output/work_times.h"
#include "sandbox/session/baking/captures.h"
#include "sandbox/session/drawing/session_costs.h"
#include "sandbox/session/loading/kept_ledger.h"
#include "sandbox/session/loading/kept_selftest.h"
#include "sandbox/session/loading/ledger_header.h"
#include "sandbox/session/loading/scene_files.h"
#include "sandbox/session/loading/scene_loading.h"
#include "sandbox/session/program_knobs.h"
#include "sandbox/session/session.h"

namespace gloam {
namespace {

/// Shows a progress bar on a terminal, otherwise a line for each finished row. Keeps the pictures.
class ConsoleProgress final : public CostProgress {
 public:
  ConsoleProgress(Console& console, const PictureFolder& pictures, bool quiet)
      : console_(console), pictures_(pictures), quiet_(quiet) {}

  void plan(const std::vector<PlannedRow>& rows) override {
    std::vector<std::string> kinds;
    for (const PlannedRow& row : rows)
      kinds.push_back(std::string(row.is_default ? "default" : "timed") + (row.from_reference ? ", reference" : ""));
    left_.plan(std::move(kinds));
  }

  void measuring(const std::string& knob, const std::string& value, std::size_t done, std::size_t total) override {
    if (quiet_) return;
    const std::string camera = cameras_ > 1 ? formatted("camera %zu of %zu, ", camera_ + 1, cameras_) : std::string();
    const std::string row = knob + "=" + value + time_left_text(left_.seconds());
    console_.show_progress(progress_line(done, total, camera + row, 0, 0.0));
  }

  Status picture(const std::string& name, const Picture& picture) override { return pictures_.save(name, picture); }
  void phase(CostPhase phase) override { phases_.begin(phase); }
  bool has_picture(const std::string& name) override { return pictures_.has(name); }

  void finished(const LedgerRow& row, bool resumed) override {
    ++(resumed ? resumed_ : measured_);
    const double took_s = std::chrono::duration<double>(Clock::now() - std::exchange(begin_, Clock::now())).count();
    left_.finished(resumed ? std::nullopt : std::optional(took_s));
    if (quiet_ || console_.shows_progress()) return;
    const std::string times = row.is_default ? std::string(": the default")
                              : row.pairs == 0
                                  ? ": the default's picture, not timed"
                                  : formatted(": %.2f (%.2f-%.2f) of the default's time, %u pairs of frames", row.ratio,
                                              row.ratio_low, row.ratio_high, row.pairs);
    console_.print(row.knob + "=" + row.value + times +
                   (resumed ? " (measured before)" : time_left_text(left_.seconds())) + "\n");
    // Flush, so that the reader of a pipe gets the line at once. A failure to write is reported at the end.
    static_cast<void>(console_.flush());
  }

  void begin_camera(std::size_t camera, std::size_t cameras) override {
    camera_ = camera;
    cameras_ = cameras;
    begin_ = Clock::now();
    if (cameras > 1 && !quiet_ && !console_.shows_progress())
      console_.print(formatted("camera %zu of %zu: ", camera + 1, cameras) + names_[camera] + "\n");
  }
  /// For each camera, what its line says.
  void name_cameras(std::vector<std::string> names) { names_ = std::move(names); }

  void finished_point(const LedgerPoint& point, bool resumed) override {
    if (quiet_ || console_.shows_progress()) return;
    const LedgerRow& row = point.measured;
    console_.print(settings_text(point.settings) +
                   formatted(": %.2f (%.2f-%.2f) of the default's time, error %.4f, %u pairs of frames", row.ratio,
                             row.ratio_low, row.ratio_high, row.flip->mean, row.pairs) +
                   (resumed ? " (measured before)" : "") + "\n");
    static_cast<void>(console_.flush());
  }

  /// What measuring took, by kinds of work, in one line.
  [[nodiscard]] std::string times() { return phases_.text(); }
  [[nodiscard]] std::size_t resumed() const { return resumed_; }
  [[nodiscard]] std::size_t rows() const { return resumed_ + measured_; }

 private:
  using Clock = std::chrono::steady_clock;
  Console& console_;
  const PictureFolder& pictures_;
  bool quiet_ = false;
  std::size_t measured_ = 0;
  std::size_t resumed_ = 0;
  std::size_t camera_ = 0;
  std::size_t cameras_ = 1;
  std::vector<std::string> names_;
  Clock::time_point begin_;  ///< end of the row before: rows that are timed together end together
  TimeLeft left_;
  WorkTimes phases_;
};

/// Why scene.reuse has no rows.
constexpr const char* kEveryFrame = "ledgers measure frames in which something changes";

/// All that a ledger can vary: the modules' knobs, the engine's, and the resolution scale.
KnobRegistry measurable_knobs() {
  KnobRegistry registry;
  for (const auto& module : make_all_modules()) module->knobs(registry);
  add_renderer_knobs(registry);
  return registry;
}

std::string conditions_of(const Options& options) {
  return "seed " + std::to_string(options.seed) + " dt " + formatted("%f", options.dt_s) + " view '" + options.view +
         "' animation '" + options.animation + "'";
}

/// Why a knob of the module changes nothing; empty: it may. The knob that switches the module off may.
std::string idle_reason(const Module& module, const std::string& knob, const Session& session) {
  const Demand demand = module.demand(session.world, nullptr);
  if (!demand.needed) return "the scene does not call for " + std::string(module.name()) + ": " + demand.reason;
  const std::string off = module.switched_off(session.world, session.renderer->knobs());
  return off.empty() || off.starts_with(knob + "=") ? "" : std::string(module.name()) + " is switched off: " + off;
}

/// Knobs of effects that the scene does not demand, or that a knob switches off, change nothing: they are measured only
/// if the user names them.
CostRequest make_request(Session& session, const Options& options, const std::vector<std::string>& chosen) {
  CostRequest request = {.header = ledger_header(session, options),
                         .conditions = conditions_of(options),
                         .points = options.points.value_or(options.quick ? kQuickPoints : kLedgerPoints),
                         .sequence = options.frames,
                         .folder = options.out};
  for (const std::string& name : chosen) {
    const std::string& owner = session.renderer->knobs().find(name)->module;
    std::string reason;
    for (const auto& module : session.renderer->modules())
      if (module->name() == owner && options.knobs.empty()) reason = idle_reason(*module, name, session);
    if (name == kFrameReuse.name && options.knobs.empty()) reason = kEveryFrame;
    if (name == kLodPixels.name && options.knobs.empty() && !may_have_levels(session.world)) reason = kNoLevels;
    if (reason.empty())
      request.knobs.push_back(name);
    else
      request.skipped.push_back({name, reason});
  }
  return request;
}

/// In quotes for a shell, if it needs them.
std::string shell_word(const std::string& text) {
  constexpr std::string_view kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./:=,+@%";
  if (!text.empty() && text.find_first_not_of(kPlain) == std::string::npos) return text;
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

/// The command line that measures the ledger again: all options that change a row.
std::string command_line(const Options& options) {
  std::string line = "gloam cost " + shell_word(options.scene) + " --out " + shell_word(options.out);
  const auto add = [&](std::string_view name, const std::string& value, bool given) {
    if (given) line.append(" ").append(name).append(" ").append(shell_word(value));
  };
  const Options standard;
  if (options.quick) line += " --quick";
  add("--points", std::to_string(options.points.value_or(0)), options.points.has_value());
  add("--minutes", formatted("%.17g", options.minutes.value_or(0.0)), options.minutes.has_value());
  add("--size", formatted("%ux%u", options.width, options.height), options.size_given);
  add("--knobs", options.knobs, !options.knobs.empty());
  add("--camera", options.camera, !options.camera.empty());
  add("--cameras", options.cameras, !options.cameras.empty());
  if (options.path) line += " --path";
  add("--time", formatted("%.17g", options.time_s), options.time_s != standard.time_s);
  add("--dt", formatted("%.17g", options.dt_s), options.dt_s != standard.dt_s);
  add("--frames", std::to_string(options.frames), options.frames != standard.frames);
  add("--seed", std::to_string(options.seed), options.seed != standard.seed);
  add("--view", options.view, options.view != standard.view);
  add("--animation", options.animation, !options.animation.empty());
  add("--device", options.device, options.device != standard.device);
  add("--threads", std::to_string(options.threads), options.threads != standard.threads);
  add("--config", options.config, !options.config.empty());
  for (const std::string& assignment : options.assignments) add("--set", assignment, true);
  return line;
}

Status write_report(const Ledger& ledger, const Options& options, const std::vector<KnobMeaning>& knobs,
                    const PictureFolder& pictures, LogSink& log) {
  ReportRequest request = {.command = command_line(options), .meanings = knobs, .picture = {}};
  request.picture = [&](const std::string& name) { return pictures.small_file(name); };
  const auto selftest = find_selftest(options, ledger.header.device, ledger.header.driver, log);
  if (selftest) request.stability = &*selftest;
  return write_file(options.out + "/report.html", ledger_report(ledger, request));
}

Status write_ledger(const Ledger& ledger, const std::string& folder) {
  GLOAM_TRY(make_folder_of(folder + "/ledger.json"));
  GLOAM_TRY(write_file(folder + "/ledger.json", ledger_json(ledger)));
  GLOAM_TRY(write_file(folder + "/ledger.csv", ledger_csv(ledger)));
  return ledger.points.empty() ? Status() : write_file(folder + "/points.csv", points_csv(ledger));
}

struct MeasuredCameras {
  Ledger ledger;
  std::vector<KnobMeaning> knobs;
};

/// A camera and the session that draws it. Sessions stay open until combinations are measured in all cameras.
struct OpenedCamera {
  MeasuredCamera camera;
  std::unique_ptr<Session> session;
  std::unique_ptr<SessionCosts> costs;
};

/// Opens a session for each camera, so that its rows do not depend on what was drawn before.
Result<std::vector<OpenedCamera>> open_cameras(const Options& options, const CommandContext& context) {
  std::vector<OpenedCamera> opened;
  std::vector<MeasuredCamera> cameras = {{.options = options}};
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    auto session = open_session(cameras[i].options, context.log);
    if (!session) return session.error();
    if (i == 0) {
      auto all = measured_cameras(options, **session);
      if (!all) return all.error();
      cameras = std::move(all).value();
      opened.reserve(cameras.size());  // costs keep references to the options
    }
    OpenedCamera& own = opened.emplace_back(OpenedCamera{cameras[i], std::move(session).value(), nullptr});
    GLOAM_TRY(place_camera(own.camera, *own.session));
    GLOAM_TRY(ensure_baked(*own.session, own.camera.options, context.log, &context.console));
    own.costs = std::make_unique<SessionCosts>(*own.session, own.camera.options);
  }
  return opened;
}

Result<MeasuredCameras> measure_cameras(const Options& options, const std::vector<std::string>& chosen,
                                        const CommandContext& context, ConsoleProgress& progress) {
  auto opened = open_cameras(options, context);
  if (!opened) return opened.error();
  MeasuredCameras measured;
  std::vector<CostCamera> cameras;
  std::vector<std::string> names;
  for (const OpenedCamera& own : *opened) {
    CostCamera& camera =
        cameras.emplace_back(CostCamera{make_request(*own.session, own.camera.options, chosen), own.costs.get()});
    camera.request.header.camera = own.camera.name();
    names.push_back((own.camera.options.camera.empty() ? std::string("the first") : own.camera.name()) +
                    formatted(" at %g s", own.camera.options.time_s));
  }
  for (const Knob& knob : opened->front().session->renderer->knobs().knobs())
    measured.knobs.push_back({knob.name, knob.meaning, value_text(knob, knob.default_number)});
  progress.name_cameras(std::move(names));
  auto ledger = measure_costs(cameras, progress);
  if (!ledger) return ledger.error();
  for (const OpenedCamera& own : *opened) GLOAM_TRY(own.session->check_validation());
  measured.ledger = std::move(ledger).value();
  return measured;
}

}  // namespace

Status measure_scene(const CommandContext& context) {
  Options options = context.options;
  if (options.quick && !options.size_given) {
    options.width = kQuickWidth;
    options.height = kQuickHeight;
  }
  GLOAM_TRY(check_scene_exists(options.scene));
  const auto chosen = choose_knobs(measurable_knobs(), options.knobs);
  if (!chosen) return chosen.error();
  // Fail before minutes of measuring whose results could not be written.
  GLOAM_TRY(make_folder_of(options.out + "/ledger.json"));

  const std::uint64_t files = scene_files_hash(options.scene);
  const PictureFolder pictures(options.out + "/pictures");
  ConsoleProgress progress(context.console, pictures, options.quiet);
  const auto measured = measure_cameras(options, *chosen, context, progress);
  context.console.show_progress("");
  if (!measured) return measured.error();
  const Ledger& ledger = measured->ledger;
  if (scene_files_hash(options.scene) != files)
    return Error{ErrorKind::input, options.scene + " changed while it was measured: no ledger is written; run again"};
  GLOAM_TRY(write_ledger(ledger, options.out));
  if (const Status kept = keep_ledger(ledger, options); !kept.ok()) context.log.warning(kept.error().message);
  GLOAM_TRY(write_report(ledger, options, measured->knobs, pictures, context.log));
  context.console.print(ledger_table(ledger) + points_table(ledger));
  if (options.quiet) return {};
  if (progress.resumed() > 0)
    context.console.print(std::to_string(progress.resumed()) + " of " + std::to_string(progress.rows()) +
                          " rows were measured before\n");
  context.console.print(progress.times());
  context.console.print("wrote " + options.out + "/report.html, ledger.json and ledger.csv\n");
  return {};
}

Status run_cost(const CommandContext& context) {
  if (!context.options.merge.empty()) return run_merge(context);
  return context.options.scene_list.empty() ? measure_scene(context) : run_sweep(context);
}

}  // namespace gloam

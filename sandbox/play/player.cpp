// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/play/player.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <system_error>
#include <utility>

#include "engine/core/text/formatted.h"
#include "sandbox/output/file_io.h"
#include "sandbox/play/display/screenshot_path.h"
#include "sandbox/play/input/dropped_scene.h"
#include "sandbox/session/baking/captures.h"
#include "sandbox/session/drawing/frame_tracing.h"
#include "sandbox/session/drawing/session_budget.h"
#include "sandbox/session/loading/scene_loading.h"
#include "sandbox/session/program_knobs.h"
#include "sandbox/session/results/run_output.h"

namespace gloam {
namespace {

constexpr double kRadiansPerPixel = 0.003;
constexpr double kStickRadians = 1.8;  // per second
constexpr double kFastFactor = 5.0;
constexpr double kLongestStep = 0.1;                        // seconds: limits the time step after a pause
constexpr std::chrono::milliseconds kPatienceAtClose(100);  // for a frame to end after the window was closed
constexpr std::chrono::milliseconds kLongFrame(400);        // after this the window's title says what is being done
// Frames after one of full size whose times may still contain it or the change of size.
constexpr std::uint32_t kUnjudgedAfterFull = gpu::Device::kFramesInFlight + 2;
constexpr double kKeptPictureS = 0.05;
constexpr double kLineReach = 6.0;  // pixels of a standard display from which the pointer grabs the wipe's line

std::string indirect_light(const Session& session) {
  const KnobRegistry& knobs = session.renderer->knobs();
  const Knob* source = knobs.find("lighting.indirect");
  return source == nullptr ? std::string() : knobs.text(*source);
}

}  // namespace

Player::Player(const Options& options, Session& session, WindowPictures& pictures, Lasting& lasting, LogSink& log)
    : options_(options),
      session_(session),
      pictures_(pictures),
      lasting_(lasting),
      log_(log),
      orbit_(session),
      on_software_(session.device->info().type == gpu::DeviceType::cpu),
      scale_(scale_limits(on_software_).budget, lasting.scale),
      upscaler_(*session.device),
      kept_picture_(*session.device),
      title_(pictures.window()),
      panel_(session, pictures.window().content_scale(), lasting.panel),
      wipe_(session),
      shaders_(options.shaders),
      time_s_(options.time_s) {
  settings_ = session.view_settings(options.width, options.height, options.view);
  captured_light_ = indirect_light(session);
  last_ns_ = session.zones.now_ns();
}

Status Player::run() {
  Window& window = pictures_.window();
  std::uint32_t frames = 0;
  while (options_.frames == 0 || frames < options_.frames) {
    leave_at_signal();
    note_progress();
    WindowInput input = poll();
    count_step();
    adapt_to_time();
    reload_shaders();
    panel_.set_scale(window.content_scale());
    GLOAM_TRY(panel_.update(input, {window.width(), window.height(), frame_s_}, settings_, scale_, controls()));
    steer_wipe(input);
    if (window.should_close() || (input.leave && panel_.may_leave(options_.scene))) break;
    keep_settings();
    GLOAM_TRY(obey(input));
    follow_indirect_light();
    if (!next_scene_.empty()) break;
    drop_view_without_its_knob();
    GLOAM_TRY(move_camera(input));
    choose_refinement(input);
    // A new range would be a new picture.
    if (refinement_.now() == Refinement::Next::reduced) GLOAM_TRY(heat_.choose(session_, settings_, shown_));
    choose_readiness();
    const auto drawn = draw();
    if (!drawn) return drawn.error();
    shown_ = *drawn;
    if (shown_) GLOAM_TRY(count_shown(frames++ == 0));
  }
  panel_.keep_changes(options_.scene, log_);
  keep_settings();
  return session_.renderer->wait();
}

/// Tells the owner about changed settings while the program runs, so that they outlive its end by a signal.
void Player::keep_settings() {
  if (lasting_.scale == scale_.setting() && lasting_.panel == panel_.shown()) return;
  lasting_.scale = scale_.setting();
  lasting_.panel = panel_.shown();
  if (lasting_.keep) lasting_.keep();
}

PlayControls Player::controls() {
  return {.scene = options_.scene,
          .time_s = time_s_,
          .paused = paused_,
          .pause = [this](bool paused) { pause(paused); },
          .show_camera = [this](std::uint32_t number) { show_camera(number); },
          .copy = [this](const std::string& text) { pictures_.window().copy(text); },
          .drawn_scale = drawn_scale_,
          .scale_note = scale_note(),
          .fly_to = [this](const dvec3& position) { fly_to(position); },
          .look_along = [this](const dvec3& direction) { look_along(direction); },
          .wipe = wipe_.shown(),
          .set_wipe = [this](const PanelWipe& wanted) { set_wipe(wanted); },
          .progress = progress_};
}

/// The camera stays on its side of the position, at most kNear away.
void Player::fly_to(const dvec3& position) {
  constexpr double kNear = 3.0;
  const dvec3 eye = this->eye(), away = eye - position;
  const double distance = glm::length(away);
  flight_.fly_to(session_.world, distance > kNear ? position + away * (kNear / distance) : eye, position, settings_);
}

void Player::look_along(const dvec3& direction) {
  const dvec3 eye = this->eye();
  flight_.fly_to(session_.world, eye, eye + direction, settings_);
}

dmat4 Player::shown_camera() const {
  ViewSettings seen = settings_;
  if (seen.follow_camera) follow_camera(session_.world, seen);
  return seen.world_from_camera;
}

dvec3 Player::eye() const { return dvec3(shown_camera()[3]); }

void Player::pause(bool paused) {
  paused_ = paused;
  wipe_paused_ = false;
}

void Player::set_wipe(const PanelWipe& wanted) {
  const bool stands = wanted.on && wanted.side == WipeSide::exact;
  if (stands && !paused_) {
    pause(true);
    wipe_paused_ = true;
  }
  if (!stands && wipe_paused_) pause(false);
  wipe_.set(wanted);
}

/// Drags the wipe's line; Escape ends the wipe.
void Player::steer_wipe(WindowInput& input) {
  PanelWipe wipe = wipe_.shown();
  if (!wipe.on) return;
  const Window& window = pictures_.window();
  if (wipe_line_.steer(wipe.at, input, window.width(), !panel_.uses_pointer(), kLineReach * window.content_scale())) {
    input.drag_x = input.drag_y = 0.0;
    input.clicked = false;
    wipe_.set(wipe);
  }
  if (!input.leave) return;
  input.leave = wipe.on = false;
  set_wipe(wipe);
}

void Player::note_progress() {
  const FrameReport report = session_.renderer->report();
  progress_ = {.name = report.pipeline_made, .left = report.pipelines_pending};
  progress_.name.resize(std::min(progress_.name.find(' '), progress_.name.size()));  // without its constants
}

/// The first picture of a scene, of a camera or of changed shaders is whole. After it no frame waits for pipelines:
/// changed knobs keep their last values until theirs are ready. Measured frames wait.
void Player::choose_readiness() {
  const bool measured = options_.frames > 0 || !options_.stats.empty() || !options_.trace.empty();
  const bool waits = measured || !whole_ || settings_.camera_cut;
  session_.renderer->set_readiness(waits ? Readiness::wait : Readiness::background);
}

WindowInput Player::poll() {
  play_script();
  // Nothing changes in the window: it is only drawn again in case something has covered it. Measured runs do not wait.
  const bool same = refinement_.now() == Refinement::Next::kept || (kept_ && options_.frames == 0);
  if (same && !active_) pictures_.window().wait(kKeptPictureS);
  return pictures_.window().poll();
}

/// The events that are not the window's are done here.
void Player::play_script() {
  const auto exists = [](const std::string& path) {
    std::error_code fault;
    return std::filesystem::exists(path, fault);
  };
  const ScriptEvent event = lasting_.script.next(exists, progress_.left == 0);
  if (event.kind == ScriptEvent::Kind::say) {
    if (const Status said = write_file(event.text, ""); !said.ok()) log_.warning(said.error().message);
  } else if (event.kind == ScriptEvent::Kind::pace) {
    script_step_s_ = event.x;
  } else if (event.kind == ScriptEvent::Kind::widget) {
    if (const auto middle = panel_.widget(event.text)) {
      pictures_.window().inject({.kind = ScriptEvent::Kind::move, .x = middle->x, .y = middle->y});
    } else {
      log_.warning("the panel shows no widget '" + event.text + "'");
    }
  } else {
    pictures_.window().inject(event);
  }
}

/// Does what keys and dropped files ask for.
Status Player::obey(const WindowInput& input) {
  if (input.full_screen) pictures_.window().toggle_full_screen();
  if (input.pause) pause(!paused_);
  step_once_ = input.step;
  if (input.step) pause(true);
  if (input.camera > 0) show_camera(input.camera);
  if (std::string scene = dropped_scene(input.dropped, log_); !scene.empty()) next_scene_ = std::move(scene);
  return input.screenshot && shown_ ? save_screenshot() : Status();
}

/// Shows the scene's camera of this number, from 1 on, and ends the flight.
void Player::show_camera(std::uint32_t number) {
  if (number > session_.info.cameras.size()) return;
  const Entity camera = session_.info.cameras[number - 1];
  if (const Status posed = check_camera_pose(session_.world, {.camera_entity = camera}); !posed.ok())
    return log_.warning(posed.error().message);
  session_.camera = camera;
  settings_ = session_.view_settings(settings_.width, settings_.height, settings_.visualizer);
  settings_.camera_cut = true;
  ++views_;
  flight_ = {};
  orbit_.reset();
}

/// Draws the picture at the window's size without the panel, as `gloam render` does, and writes it to the first free
/// out/<scene>-NNN.png. A file that cannot be written is a warning.
Status Player::save_screenshot() {
  session_.set_clock(time_s_, 0.0);
  session_.renderer->set_readiness(Readiness::wait);
  std::vector<FrameSample> samples;
  const auto draw_whole = [&]() -> Status {
    auto sample = session_.render_frame({.settings = settings_, .target = {}});
    if (!sample) return sample.error();
    samples.push_back(std::move(sample).value());
    return {};
  };
  GLOAM_TRY(run_beside(draw_whole));
  const std::string path = screenshot_path(options_.scene);
  const Status written = write_picture({.session = session_, .view = settings_, .samples = samples}, path);
  if (!written.ok()) log_.warning(written.error().message);
  if (written.ok()) title_.say("gloam: wrote " + path);
  drawn_scale_ = 1.0;
  return {};
}

/// A changed knob may make the visualizer unavailable. Then warn, return to the lit picture and go on.
void Player::drop_view_without_its_knob() {
  if (settings_.visualizer == "none") return;
  Status shows = session_.renderer->check_visualizer(session_.world, settings_.visualizer);
  if (shows.ok()) shows = check_shown_live(*session_.renderer, settings_.visualizer);
  if (shows.ok()) return;
  log_.warning(shows.error().message);
  settings_.visualizer = "none";
}

void Player::count_step() {
  const std::uint64_t now = session_.zones.now_ns();
  frame_s_ = static_cast<double>(now - last_ns_) * 1e-9;
  step_s_ = script_step_s_.value_or(std::min(frame_s_, kLongestStep));
  last_ns_ = now;
}

Status Player::move_camera(const WindowInput& input) {
  FlyInput flight = {.forward = input.forward,
                     .right = input.right,
                     .up = input.up,
                     .turn = input.turn * kStickRadians * step_s_ - input.drag_x * kRadiansPerPixel,
                     .tilt = input.tilt * kStickRadians * step_s_ - input.drag_y * kRadiansPerPixel,
                     .speed = input.fast ? kFastFactor : 1.0};
  if (shown_) GLOAM_TRY(orbit_.add(input, settings_, drawn_scale_, flight));
  flight_.advance(session_.world, flight, step_s_, settings_);
  return {};
}

/// On a software device the whole turn counts. A GPU waits for the display, so there its own time counts.
void Player::adapt_to_time() {
  if (!shown_) return;
  Renderer& renderer = *session_.renderer;
  const FrameReport report = renderer.report();
  const double ms = on_software_ ? frame_s_ * 1e3 : report.gpu_ms;
  const bool own = unjudged_ == 0;
  if (unjudged_ > 0) --unjudged_;
  kept_ = report.kept;  // its time does not tell how long the next one takes that is drawn
  const bool judged = wipe_.judges_frame() && own && !kept_;
  const dmat4 camera = shown_camera();
  camera_moves_ = camera != last_camera_;
  last_camera_ = camera;
  if (!options_.budget_ms && judged) scale_.add(ms, camera_moves_);
  for (const BudgetDecision& told : add_frame_times(renderer, {.ms = ms, .judged = judged, .view = views_}, report))
    panel_.tell(budget_text(told.decision, *renderer.budget(told.effect)), false);
}

double Player::moving_scale() const {
  return options_.budget_ms ? view_scale(session_.renderer->knobs()) : scale_.scale();
}

double Player::scale() const { return refinement_.now() == Refinement::Next::reduced ? moving_scale() : 1.0; }

void Player::choose_refinement(const WindowInput& input) {
  active_ = !(input.panel == last_panel_input_);
  last_panel_input_ = input.panel;
  const bool stands = (paused_ && !step_once_) || (options_.fixed_step && options_.dt_s == 0.0);
  const bool moves = !stands && scene_moves(session_);
  // A chosen scale stays, as does that of a budget, whose setting the window shows; and so do measured runs.
  const bool wanted = scale_.setting() == 0.0 && !options_.budget_ms && options_.frames == 0;
  if (!wanted || moves || wipe_.on() || heat_.is_due() || moving_scale() == 1.0) return refinement_.restart();
  PictureMoment moment = picture_moment(session_, settings_, stands ? time_s_ : 0.0);
  moment.numbers.push_back(static_cast<double>(reloads_));
  moment.numbers.push_back(progress_.left > 0 ? 1.0
                                              : 0.0);  // effects may be left out, and knobs have their last values
  const std::uint32_t frames = session_.renderer->frames_to_rest(session_.world);
  if (refinement_.next(moment, frame_s_, active_, frames) != Refinement::Next::reduced) unjudged_ = kUnjudgedAfterFull;
}

std::string Player::scale_note() const {
  if (moving_scale() == 1.0) return {};
  if (wipe_.on()) return "both sides of the wipe have this scale, also at rest";
  if (options_.budget_ms) return "the budget chooses the scale, also at rest";
  if (scale_.setting() > 0.0) return {};
  if (refinement_.now() != Refinement::Next::reduced)
    return "at rest: full size; " + scale_text(moving_scale(), moving_scale()) + " when something moves";
  if (!paused_ && scene_moves(session_)) return "the scene moves; pause it to see it at full size";
  return "full size when nothing moves";
}

/// Gives the world the captures that belong to lighting.indirect once its value has changed.
void Player::follow_indirect_light() {
  std::string now = indirect_light(session_);
  if (now == captured_light_) return;
  captured_light_ = std::move(now);
  whole_ = false;
  const Status captured = ensure_captures(session_, options_, log_);
  if (!captured.ok()) panel_.tell(captured.error().message, true);
}

/// Draws with the shaders that were changed; the panel shows why one cannot be used.
void Player::reload_shaders() {
  auto change = shaders_.take();
  if (!change) return;
  std::string fault = std::move(change->fault);
  std::size_t count = 0;
  for (ShaderReload::Compiled& compiled : change->compiled) {
    const Status replaced = session_.renderer->replace_shader(*compiled.shader, std::move(compiled.words));
    if (replaced.ok()) ++count;
    if (!replaced.ok() && fault.empty()) fault = replaced.error().message;
  }
  if (!fault.empty()) log_.warning(fault);
  ++reloads_;
  whole_ = false;
  panel_.tell(fault.empty() ? std::to_string(count) + (count == 1 ? " shader" : " shaders") + " compiled again" : fault,
              !fault.empty());
}

/// Draws a frame. Returns false if none was shown, because the window is minimised or changes its size.
Result<bool> Player::draw() {
  const auto visible = pictures_.follow_window();
  if (!visible.ok() || !*visible) return visible;
  if (settings_.width != pictures_.width() || settings_.height != pictures_.height() || drawn_scale_ == 0.0) {
    settings_.width = pictures_.width();
    settings_.height = pictures_.height();
    scale_.start(settings_.width, settings_.height, scale_limits(on_software_).first_pixels);
    refinement_.restart();
  }
  const bool stands = paused_ && !step_once_;
  const double dt_s = stands ? 0.0 : options_.fixed_step || step_once_ ? options_.dt_s : step_s_;
  session_.set_clock(time_s_, dt_s);
  const bool again = refinement_.now() == Refinement::Next::kept && upscaler_.kept_image();
  const auto asked = again ? ViewRequest() : request();
  if (!asked) return asked.error();
  bool shown = false;
  const auto draw_and_show = [&]() -> Status {
    if (!again) GLOAM_TRY(render(*asked));
    if (again || asked->target.keeps_image) GLOAM_TRY(show_again());
    const auto presented = pictures_.present();
    if (!presented) return presented.error();
    shown = *presented;
    return {};
  };
  GLOAM_TRY(run_beside(draw_and_show));
  if (shown) {
    if (refinement_.now() == Refinement::Next::full) refinement_.shown_full();
    time_s_ += dt_s;
    step_once_ = settings_.camera_cut = false;
    whole_ = true;
  }
  return shown;
}

Status Player::run_beside(std::function<Status()> work) {
  const auto since = std::chrono::steady_clock::now();
  const Status done = beside_.run(std::move(work), [&] { answer(since); });
  title_.rest(usual_title());
  return done;
}

std::string Player::usual_title() const {
  if (progress_.left > 0) return formatted("gloam: compiling %s, %zu left", progress_.name.c_str(), progress_.left);
  const PanelWipe wipe = wipe_.shown();
  return "gloam: " + options_.scene + (wipe.on ? ", wipe: now | " + right_side(wipe) : "");
}

void Player::answer(std::chrono::steady_clock::time_point since) {
  Window& window = pictures_.window();
  if (window.pump()) window.toggle_full_screen();
  leave_at_signal();
  const auto now = std::chrono::steady_clock::now();
  if (window.should_close()) {
    window.hide();
    if (!closed_) closed_ = now;
    if (now - *closed_ > kPatienceAtClose && !leaves_results()) leave(0);
  }
  if (now - since < kLongFrame) return;
  const PipelineProgress::State compiled = session_.pipelines.state();
  title_.busy(compiled.total == 0 ? "gloam: drawing"
                                  : formatted("gloam: compiling %s, %zu of %zu", compiled.name.c_str(),
                                              compiled.done + 1, compiled.total));
}

void Player::leave_at_signal() {
  const int number = lasting_.interrupts == nullptr ? 0 : lasting_.interrupts->arrived();
  if (number != 0) leave(kSignalExit + number);
}

/// Keeps changes and ends the process, which may be compiling or drawing.
void Player::leave(int code) {
  panel_.keep_changes(options_.scene, log_);
  if (lasting_.keep) lasting_.keep();
  end_process(code);
}

/// Whether something is written or checked after the last frame.
bool Player::leaves_results() const {
  const Options& o = options_;
  return o.frames > 0 || !o.out.empty() || !o.stats.empty() || !o.trace.empty() || o.pick || o.validate;
}

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <utility>
#include <vector>

#include "engine/core/env.h"
#include "engine/gpu/vulkan_device.h"
#include "sandbox/commands/commands.h"
#include "sandbox/session/captures.h"
#include "sandbox/session/frame_tracing.h"
#include "sandbox/session/run_output.h"
#include "sandbox/session/scene_loading.h"
#include "sandbox/session/session.h"
#include "sandbox/window/fly_camera.h"
#include "sandbox/window/play_panel.h"
#include "sandbox/window/window.h"

namespace gloam {
namespace {

constexpr double kRadiansPerPixel = 0.003;
constexpr double kFastFactor = 5.0;
constexpr double kLongestStep = 0.1;  // seconds: limits the time step after a pause

/// Shows a scene in a window, frame by frame.
class Player {
 public:
  Player(const Options& options, Window& window, Session& session, gpu::Swapchain& swapchain, LogSink& log)
      : options_(options),
        window_(window),
        session_(session),
        swapchain_(swapchain),
        log_(log),
        panel_(session, window.content_scale(), environment_text("GLOAM_PANEL") == "1"),
        time_s_(options.time_s) {
    settings_ = session.view_settings(options.width, options.height, options.view);
    last_ns_ = session.zones.now_ns();
  }

  [[nodiscard]] Status run() {
    std::uint32_t frames = 0;
    while (options_.frames == 0 || frames < options_.frames) {
      WindowInput input = window_.poll();
      count_step();
      GLOAM_TRY(panel_.update(input, {window_.width(), window_.height(), frame_s_}, settings_));
      if (window_.should_close() || input.leave) break;
      drop_view_without_its_knob();
      move_camera(input);
      const auto drawn = draw();
      if (!drawn) return drawn.error();
      if (*drawn) ++frames;
    }
    return session_.renderer->wait();
  }

  [[nodiscard]] const ViewSettings& settings() const { return settings_; }
  [[nodiscard]] const std::vector<FrameSample>& samples() const { return samples_; }

 private:
  /// A changed knob may make the visualizer unavailable. Then warn, return to the lit picture and go on.
  void drop_view_without_its_knob() {
    if (settings_.visualizer == "none") return;
    Status shows = session_.renderer->check_visualizer(session_.world, settings_.visualizer);
    if (shows.ok()) shows = check_shown_live(*session_.renderer, settings_.visualizer);
    if (shows.ok()) return;
    log_.warning(shows.error().message);
    settings_.visualizer = "none";
  }
  void count_step() {
    const std::uint64_t now = session_.zones.now_ns();
    frame_s_ = static_cast<double>(now - last_ns_) * 1e-9;
    step_s_ = std::min(frame_s_, kLongestStep);
    last_ns_ = now;
  }

  void move_camera(const WindowInput& input) {
    const FlyInput flight = {.forward = input.forward,
                             .right = input.right,
                             .up = input.up,
                             .turn = -input.drag_x * kRadiansPerPixel,
                             .tilt = -input.drag_y * kRadiansPerPixel,
                             .speed = input.fast ? kFastFactor : 1.0};
    flight_.advance(session_.world, flight, step_s_, settings_);
  }

  /// Draws a frame. Returns false if none was shown, because the window is minimised or changes its size.
  [[nodiscard]] Result<bool> draw() {
    const std::uint32_t width = window_.width();
    const std::uint32_t height = window_.height();
    if (width == 0 || height == 0) return false;
    if (!fits_ || width != settings_.width || height != settings_.height) {
      GLOAM_TRY(swapchain_.resize(width, height));
      settings_.width = width;
      settings_.height = height;
      fits_ = true;
    }
    const double dt_s = options_.fixed_step ? options_.dt_s : step_s_;
    session_.set_clock(time_s_, dt_s);
    const auto acquire = [this]() -> Result<gpu::ImageHandle> {
      auto image = swapchain_.acquire();
      fits_ = image.ok() && *image;
      return image;
    };
    GLOAM_TRY(render({.settings = settings_,
                      .target = {.after = gpu::Access::present, .acquire = acquire, .overlay = panel_.overlay()},
                      .keep_linear = false}));
    GLOAM_TRY(swapchain_.present());
    if (!fits_) return false;
    time_s_ += dt_s;
    return true;
  }

  /// Waits for the frame only if its times are needed (--stats, --trace).
  [[nodiscard]] Status render(const ViewRequest& request) {
    if (options_.stats.empty() && options_.trace.empty()) {
      static_cast<void>(session_.zones.take());
      return session_.renderer->render(session_.world, {&request, 1});
    }
    auto sample = session_.render_frame(request);
    if (!sample) return sample.error();
    samples_.push_back(std::move(sample).value());
    return {};
  }

  const Options& options_;
  Window& window_;
  Session& session_;
  gpu::Swapchain& swapchain_;
  LogSink& log_;
  ViewSettings settings_;
  ViewFlight flight_;
  PlayPanel panel_;
  std::vector<FrameSample> samples_;
  double time_s_ = 0.0;
  double frame_s_ = 0.0;  ///< since the last frame
  double step_s_ = 0.0;   ///< frame_s_, at most kLongestStep
  std::uint64_t last_ns_ = 0;
  bool fits_ = false;
};

/// Writes the picture and reports that the options ask for, from one more frame that is drawn into the renderer's own
/// image.
Status leave_results(const CommandContext& context, Session& session, const Player& player) {
  const Options& options = context.options;
  const bool wants_reports = !options.stats.empty() || !options.trace.empty() || options.pick;
  if (options.out.empty() && !wants_reports) return {};
  auto last = session.render_frame({.settings = player.settings(), .target = {}});
  if (!last) return last.error();
  std::vector<FrameSample> samples = player.samples();
  samples.push_back(std::move(last).value());
  const DrawnRun run = {.session = session, .view = player.settings(), .samples = samples};
  if (!options.out.empty()) GLOAM_TRY(write_picture(run, options.out));
  return write_reports(run, options, context.console);
}

}  // namespace

Status run_play(const CommandContext& context) {
  const Options& options = context.options;
  GLOAM_TRY(check_scene_exists(options.scene));
  const auto window = Window::open("gloam: " + options.scene, options.width, options.height);
  if (!window) return window.error();
  const auto session = open_session(
      options, context.log,
      {.extensions = window.value()->vulkan_extensions(), .create_surface = window.value()->surface_maker()});
  if (!session) return session.error();
  warn_of_missing_effects(*session.value(), context.log);
  GLOAM_TRY(ensure_baked(*session.value(), options, context.log, &context.console));
  GLOAM_TRY(check_shown_live(*session.value()->renderer, options.view));
  const auto swapchain = gpu::create_swapchain(*session.value()->device, window.value()->surface_maker());
  if (!swapchain) return swapchain.error();
  Player player(options, *window.value(), *session.value(), *swapchain.value(), context.log);
  GLOAM_TRY(player.run());
  GLOAM_TRY(leave_results(context, *session.value(), player));
  return session.value()->check_validation();
}

}  // namespace gloam

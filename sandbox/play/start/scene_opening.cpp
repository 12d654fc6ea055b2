// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/play/start/scene_opening.h"

#include <chrono>
#include <mutex>
#include <string>
#include <utility>

#include "sandbox/play/display/resolution_scale.h"
#include "sandbox/play/start/loading_screen.h"
#include "sandbox/play/start/work_beside.h"
#include "sandbox/session/baking/captures.h"
#include "sandbox/session/baking/particle_light.h"
#include "sandbox/session/drawing/frame_tracing.h"
#include "sandbox/session/drawing/session_budget.h"
#include "sandbox/session/drawing/short_ledger.h"
#include "sandbox/session/loading/kept_ledger.h"
#include "sandbox/session/loading/kept_pipelines.h"
#include "sandbox/session/program_knobs.h"

namespace gloam {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kBetweenPictures(30);
constexpr ViewId kUnseenView{2};  // the views of the window keep no history of the first frame

/// The steps of opening a scene, on a thread of their own.
class Opening {
 public:
  Opening(const Options& options, LogSink& log, double scale) : options_(options), log_(log), scale_(scale) {}

  /// width, height: of the window, in pixels.
  [[nodiscard]] Status run(const WindowNeeds& window, std::uint32_t width, std::uint32_t height);
  [[nodiscard]] std::unique_ptr<Session> take_session() { return std::move(session_); }
  /// For other threads, at any time.
  [[nodiscard]] LoadingStep step() const;

 private:
  void tell(LoadingStep step);
  [[nodiscard]] BakeProgress teller(const char* what);
  [[nodiscard]] Status choose_budgets(const Options& drawn);
  [[nodiscard]] Status draw_unseen_frame(const Options& drawn);

  const Options& options_;
  LogSink& log_;
  double scale_;
  std::unique_ptr<Session> session_;
  mutable std::mutex mutex_;
  LoadingStep step_;
  const PipelineProgress* pipelines_ = nullptr;  ///< of the session, once there is one
};

LoadingStep Opening::step() const {
  const std::lock_guard lock(mutex_);
  const auto compiled = pipelines_ == nullptr ? PipelineProgress::State() : pipelines_->state();
  if (compiled.total == 0) return step_;
  return {.what = "compiling " + compiled.name, .done = compiled.done, .total = compiled.total};
}

void Opening::tell(LoadingStep step) {
  const std::lock_guard lock(mutex_);
  step_ = std::move(step);
}

BakeProgress Opening::teller(const char* what) {
  tell({.what = what});
  return [this, what](std::size_t done, std::size_t total) { tell({.what = what, .done = done, .total = total}); };
}

Status Opening::run(const WindowNeeds& window, std::uint32_t width, std::uint32_t height) {
  tell({.what = "opening the device"});
  auto device = open_device(options_, log_, window);
  if (!device) return device.error();
  auto session = open_empty_session(std::move(device).value(), options_, log_);
  if (!session) return session.error();
  session_ = std::move(session).value();
  {
    const std::lock_guard lock(mutex_);
    pipelines_ = &session_->pipelines;
    step_ = {.what = "loading the scene"};
  }
  make_kept_pipelines(*session_, options_, log_);
  GLOAM_TRY(fill_session(*session_, options_, log_));
  GLOAM_TRY(ensure_captures(*session_, options_, log_, teller("capturing reflections")));
  GLOAM_TRY(ensure_particle_light(*session_, options_, log_, teller("tracing the light of particles")));
  Options drawn = options_;
  drawn.width = width;
  drawn.height = height;
  GLOAM_TRY(choose_budgets(drawn));
  return draw_unseen_frame(drawn);
}

/// Sets the budgets of --budget. Frames of a scene without a ledger of its own are measured for some seconds.
Status Opening::choose_budgets(const Options& drawn) {
  if (!has_budget(drawn)) return {};
  auto own = find_own_ledger(*session_, drawn, log_);
  if (!own) return own.error();
  if (*own) return set_budgets(*session_, drawn, **own, log_);
  if (!drawn.budget_ms) return set_budgets(*session_, drawn, log_);
  const BakeProgress progress = teller("measuring settings for --budget");
  auto ledger = measure_session_shortly(*session_, drawn, [&](std::size_t done, std::size_t total) {
    progress(done, total);
    return Status();
  });
  if (!ledger) return ledger.error();
  if (const Status kept = keep_ledger(*ledger, options_); !kept.ok()) log_.warning(kept.error().message);
  return set_budgets(*session_, drawn, {std::move(ledger).value(), "the short ledger"}, log_);
}

/// No time passes in it.
Status Opening::draw_unseen_frame(const Options& drawn) {
  tell({.what = "drawing the first frame: the driver may compile shaders in it"});
  Renderer& renderer = *session_->renderer;
  GLOAM_TRY(check_shown_live(renderer, drawn.view));
  const bool on_software = session_->device->info().type == gpu::DeviceType::cpu;
  const ScaleLimits limits = scale_limits(on_software);
  ResolutionScale automatic(limits.budget, scale_);
  automatic.start(drawn.width, drawn.height, limits.first_pixels);
  const double scale = drawn.budget_ms ? view_scale(renderer.knobs()) : automatic.scale();
  ViewSettings view =
      session_->view_settings(scaled_side(drawn.width, scale), scaled_side(drawn.height, scale), drawn.view);
  view.id = kUnseenView;
  session_->set_clock(drawn.time_s, 0.0);
  const ViewRequest request = {.settings = view, .target = {}, .keep_linear = false};
  GLOAM_TRY(renderer.render(session_->world, {&request, 1}));
  keep_pipelines(*session_, options_, log_);
  GLOAM_TRY(renderer.wait());
  renderer.release_view(session_->world, kUnseenView);
  static_cast<void>(session_->zones.take());
  return {};
}

}  // namespace

Result<std::unique_ptr<Session>> open_in_window(Window& window, const Options& options, double scale,
                                                const Interrupts& interrupts, LogSink& log) {
  const auto screen = LoadingScreen::open(window, options, log);
  if (!screen) return screen.error();
  Opening opening(options, log, scale);
  Status shown;
  Clock::time_point next_picture = Clock::now();
  const auto answer = [&] {
    if (interrupts.arrived() != 0) end_process(kSignalExit + interrupts.arrived());
    if (Clock::now() < next_picture) return;
    const WindowInput input = window.poll();
    if (input.leave || window.should_close()) end_process(0);
    if (input.full_screen) window.toggle_full_screen();
    if (shown.ok()) shown = (*screen)->show(opening.step());
    next_picture = Clock::now() + kBetweenPictures;
  };
  const WindowNeeds needs = {.extensions = window.vulkan_extensions(), .create_surface = window.surface_maker()};
  const std::uint32_t width = window.width() > 0 ? window.width() : options.width;
  const std::uint32_t height = window.height() > 0 ? window.height() : options.height;
  GLOAM_TRY(WorkBeside().run([&] { return opening.run(needs, width, height); }, answer));
  GLOAM_TRY(shown);
  if ((*screen)->validation_messages() > 0)
    return Error{ErrorKind::failed, "Vulkan validation has messages of the loading screen"};
  return opening.take_session();
}

}  // namespace gloam

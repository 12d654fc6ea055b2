// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <string>
#include <utility>
#include <vector>

#include "engine/core/env.h"
#include "engine/gpu/vulkan_device.h"
#include "sandbox/commands/commands.h"
#include "sandbox/output/file_io.h"
#include "sandbox/play/display/window_pictures.h"
#include "sandbox/play/player.h"
#include "sandbox/play/settings.h"
#include "sandbox/play/start/interrupts.h"
#include "sandbox/play/start/scene_opening.h"
#include "sandbox/session/loading/scene_loading.h"
#include "sandbox/session/results/run_output.h"
#include "sandbox/session/session.h"
#include "sandbox/window/window.h"

namespace gloam {
namespace {

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

/// Shows one scene in the window. Returns the scene to show next; empty: the user has left.
Result<std::string> play_scene(const CommandContext& context, Window& window, Player::Lasting& lasting) {
  const Options& options = context.options;
  const auto session = open_in_window(window, options, lasting.scale, *lasting.interrupts, context.log);
  if (!session) return session.error();
  const auto swapchain = gpu::create_swapchain(*session.value()->device, window.surface_maker());
  if (!swapchain) return swapchain.error();
  WindowPictures pictures(window, **swapchain);
  Player player(options, **session, pictures, lasting, context.log);
  GLOAM_TRY(player.run());
  if (player.next_scene().empty()) GLOAM_TRY(leave_results(context, **session, player));
  GLOAM_TRY(session.value()->check_validation());
  return player.next_scene();
}

/// Shows scenes until the user leaves. A dropped scene that cannot be shown is a warning, and the last one returns.
Status play_scenes(const CommandContext& context, Window& window, Player::Lasting& lasting) {
  Options options = context.options;
  std::string last;
  while (true) {
    auto next = play_scene({options, context.console, context.log}, window, lasting);
    if (!next && !last.empty() && next.error().kind == ErrorKind::input) {
      context.log.warning(next.error().message);
      next = std::exchange(last, {});
    } else {
      last = options.scene;
    }
    if (!next) return next.error();
    if (next->empty()) return {};
    options.scene = *next;
    options.camera.clear();  // camera and animation are names of the first scene
    options.animation.clear();
    options.lights.clear();
    window.set_title("gloam: " + options.scene);
  }
}

Result<InputScript> read_script(const std::string& path) {
  if (path.empty()) return InputScript();
  const auto text = read_text_file(path, ErrorKind::usage);
  if (!text) return text.error();
  return InputScript::parse(*text, path);
}

/// Takes over what the last run left, except what the command line gives.
void apply_settings(const PlaySettings& settings, Options& options) {
  if (!options.size_given) {
    options.width = settings.width;
    options.height = settings.height;
  }
  if (!options.scale_given && options.stats.empty() && options.trace.empty()) options.scale = settings.scale;
}

}  // namespace

Status run_play(const CommandContext& context) {
  PlayFigures figures(PlayFigures::Clock::now());
  const Interrupts interrupts;
  Options options = context.options;
  GLOAM_TRY(check_scene_exists(options.scene));
  auto script = read_script(options.script);
  if (!script) return script.error();
  // Runs of a number of frames are tests and measurements.
  const std::string settings_path = options.frames == 0 ? play_settings_path() : std::string();
  PlaySettings settings = load_play_settings(settings_path, context.log);
  if (!settings_path.empty()) apply_settings(settings, options);
  const auto opened = Window::open("gloam: " + options.scene, options.width, options.height);
  if (!opened) return opened.error();
  Window& window = **opened;
  Player::Lasting lasting = {.figures = std::move(figures),
                             .scale = options.scale,
                             .panel = settings.panel || environment_text("GLOAM_PANEL") == "1",
                             .script = std::move(*script),
                             .interrupts = &interrupts};
  const auto keep = [&] {
    if (const auto [width, height] = window.desktop_size(); width > 0 && !window.is_full_screen()) {
      settings.width = width;
      settings.height = height;
    }
    settings.scale = lasting.scale;
    settings.panel = lasting.panel;
    save_play_settings(settings_path, settings, context.log);
  };
  lasting.keep = keep;
  GLOAM_TRY(play_scenes({options, context.console, context.log}, window, lasting));
  if (options.frames > 0 && !options.quiet) context.console.print(lasting.figures.text() + "\n");
  keep();
  return {};
}

}  // namespace gloam

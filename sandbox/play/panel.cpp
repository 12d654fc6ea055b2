// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/play/panel.h"

#include <algorithm>
#include <utility>

#include "engine/core/text/formatted.h"
#include "engine/render/camera/light_scale.h"
#include "engine/scene/resources.h"
#include "modules/depth_of_field/components.h"
#include "modules/module_list/module_list.h"
#include "sandbox/output/file_io.h"
#include "sandbox/play/input/orbit_controls.h"
#include "sandbox/play/input/panel_settings.h"
#include "sandbox/play/input/view_projection.h"
#include "sandbox/session/drawing/frame_tracing.h"
#include "sandbox/session/loading/scene_loading.h"
#include "sandbox/session/program_knobs.h"

namespace gloam {
namespace {

/// The file of changed knobs for --config. kind: "" or ".unsaved".
std::string config_path(const std::string& scene, const char* kind) {
  return "out/" + scene_stem(scene) + kind + ".config.json";
}

}  // namespace

PlayPanel::PlayPanel(Session& session, double scale, bool shown)
    : session_(session),
      scale_(scale),
      shown_(shown),
      budgets_(*session.renderer),
      lights_(session),
      visualizers_(session.renderer->visualizers()) {
  const auto& names = session.world.resource<SceneNames>();
  for (const Entity camera : session.info.cameras) cameras_.emplace_back(names.name_of(camera));
  for (const auto& module : make_all_modules())
    for (std::string& warning : module->warnings(session.world)) warnings_.push_back(std::move(warning));
}

Status PlayPanel::open() {
  auto panel = std::make_unique<Panel>(scale_);
  auto renderer = PanelRenderer::create(*session_.device, panel->font());
  if (!renderer.ok()) return renderer.error();
  panel_ = std::move(panel);
  renderer_ = std::move(renderer).value();
  return {};
}

Status PlayPanel::update(WindowInput& input, const PanelFrame& frame, ViewSettings& view, ResolutionScale& scale,
                         const PlayControls& controls) {
  // Tab does not hide the panel while the user types text.
  if (input.toggle_panel && !(drawn_ && panel_->wants_keyboard())) shown_ = !shown_;
  drawn_ = shown_ && frame.width > 0 && frame.height > 0;
  if (!drawn_) return {};
  if (panel_ == nullptr) GLOAM_TRY(open());

  Renderer& renderer = *session_.renderer;
  const FrameReport report = renderer.report();
  times_.add(frame.dt_s * 1e3, report);
  // Escape ends text input and closes lists; only the next Escape leaves the program.
  const bool typing = panel_->wants_keyboard(), busy = panel_->is_busy();
  const auto show = [&](const std::string& visualizer) -> Status {
    GLOAM_TRY(renderer.check_visualizer(session_.world, visualizer));
    GLOAM_TRY(check_shown_live(renderer, visualizer));
    view.visualizer = visualizer;
    return {};
  };
  // A budget of whole frames chooses the scale.
  const bool chosen = renderer.budget().has_value();
  const double moving = chosen ? view_scale(renderer.knobs()) : scale.scale();
  const double drawn_at = controls.drawn_scale > 0.0 ? controls.drawn_scale : moving;
  PanelContent content = {.knobs = renderer.knobs(),
                          .times = times_,
                          .modules = report.modules,
                          .visualizers = visualizers_,
                          .visualizer = view.visualizer,
                          .show = show,
                          .scale = drawn_at,
                          .scale_note = controls.scale_note,
                          .scale_setting = scale.setting(),
                          .scale_steps = ResolutionScale::kSteps,
                          .notice = notice_,
                          .heat_range = view.heat_range};
  if (!chosen) content.set_scale = [&](double setting) { scale.set(setting); };
  const PanelScene scene = scene_of(controls, view);
  if (controls.pause) content.scene = &scene;
  ViewSettings seen = view;
  if (seen.follow_camera) follow_camera(session_.world, seen);
  this->show(input, frame, content, controls, seen);
  if (input.clicked && !panel_->wants_mouse() && !report.passes.empty()) pick(input, view, drawn_at);
  if (panel_->wants_mouse()) {
    input.drag_x = input.drag_y = input.orbit_x = input.orbit_y = input.wheel = 0.0;
    input.clicked = input.grabbed = input.look_at = false;
  }
  if (busy) input.leave = false;
  if (typing || panel_->wants_keyboard()) {
    input.forward = input.right = input.up = 0.0;
    input.fast = input.leave = input.look_at = false;
    input.pause = input.step = false;
    input.camera = 0;
  }
  return {};
}

/// The panel with the budgets.
void PlayPanel::show(WindowInput& input, const PanelFrame& frame, PanelContent& content, const PlayControls& controls,
                     const ViewSettings& view) {
  budgets_.begin();
  const PanelBudgets budgets = {
      .budgets = budgets_.budgets(),
      .set_ms = [this](std::size_t budget, double ms) { budgets_.set_ms(budget, ms); },
      .lock = [this](std::size_t budget, const std::string& knob, bool locked) { budgets_.lock(budget, knob, locked); },
      .fault = budgets_.fault()};
  content.budgets = &budgets;
  if (controls.set_wipe) content.wipe = &controls.wipe;
  content.set_wipe = controls.set_wipe;
  content.progress = controls.progress;
  const std::string knobs_before = config_text(session_.renderer->knobs());
  undo(input.panel);
  const Settings before = panel_settings(session_, lights_.controls());
  content.marks = marks(view);
  panel_->update(input.panel, frame, content);
  const bool pointer_is_free = !panel_->wants_mouse();
  if (lights_.steer(input, view, pointer_is_free)) {
    input.drag_x = input.drag_y = 0.0;
    input.clicked = false;
  }
  undo_.note(before, panel_settings(session_, lights_.controls()), panel_->is_busy() || lights_.drags());
  if (config_text(session_.renderer->knobs()) != knobs_before) {
    unsaved_ = true;
    asked_to_leave_ = false;
  }
  budgets_.end();
}

PanelScene PlayPanel::scene_of(const PlayControls& controls, const ViewSettings& view) {
  const auto& environment = std::as_const(session_.world).resource<SceneEnvironment>();
  const bool automatic = !has_stated_exposure(session_.world);
  const auto* lens = std::as_const(session_.world).try_get<DepthOfField>(session_.camera);
  const auto& cameras = session_.info.cameras;
  const auto shown = view.follow_camera ? std::ranges::find(cameras, session_.camera) : cameras.end();
  PanelScene scene = {
      .cameras = cameras_,
      .camera = shown == cameras.end() ? 0 : static_cast<std::uint32_t>(shown - cameras.begin()) + 1,
      .show_camera = controls.show_camera,
      .warnings = warnings_,
      .time_s = controls.time_s,
      .paused = controls.paused,
      .pause = controls.pause,
      .automatic_exposure = automatic,
      .ev100 = automatic ? metered_ev100() : environment.exposure_ev100,
      .set_exposure = [this](bool on, float ev100) { set_exposure(on, ev100); },
      .has_camera = session_.world.alive(session_.camera),
      .focus_m = lens != nullptr ? lens->focus_m : 0.0f,
      .f_number = lens != nullptr ? lens->f_number : DepthOfField{}.f_number,
      .picked_m = picked_m_,
      .set_lens = [this](float focus_m, float f_number) { set_lens(focus_m, f_number); },
      .locate = [this, &controls](std::size_t light) { locate(light, controls); },
      .save_lights = [this,
                      name = controls.scene] { said_ = lights_.save("out/" + scene_stem(name) + ".lights.json"); },
      .picked = picked_,
      .pick = pick_,
      .save_config = [this, scene = controls.scene] { save_config(scene); },
      .copy_command =
          [this, &controls, &view] {
            controls.copy(command_line(controls, view));
            said_ = "the command line is on the clipboard";
          },
      .said = said_};
  lights_.fill(scene, view);
  return scene;
}

void PlayPanel::locate(std::size_t light, const PlayControls& controls) {
  if (!controls.fly_to) return;
  const LightControls& lights = lights_.controls();
  if (lights.lights()[light].kind == LightKind::directional)
    controls.look_along(-lights.direction(light));
  else
    controls.fly_to(lights.position(light));
}

/// Ctrl-Z, and Ctrl-Y or Ctrl-Shift-Z.
void PlayPanel::undo(const PanelInput& input) {
  const auto is_down = [&](EditKey key) { return input.control && input.keys[static_cast<std::size_t>(key)]; };
  const bool back = is_down(EditKey::z) && !input.shift;
  const bool again = is_down(EditKey::y) || (is_down(EditKey::z) && input.shift);
  const bool struck = (back || again) && !undo_keys_down_;
  undo_keys_down_ = back || again;
  if (!struck || panel_->wants_keyboard()) return;
  const auto settings = back ? undo_.undo() : undo_.redo();
  if (settings) set_panel_settings(session_, lights_.controls(), *settings);
}

float PlayPanel::metered_ev100() const {
  const auto counters = session_.renderer->report().counters;
  const auto metered = counters.find("lighting.exposure_ev100");
  return metered == counters.end() ? 0.0f : static_cast<float>(metered->second);
}

void PlayPanel::set_exposure(bool automatic, float ev100) {
  auto& environment = session_.world.resource<SceneEnvironment>();
  environment.has_exposure = !automatic;
  environment.exposure_ev100 = ev100;
  // Metering in every frame would go on without regard to the value.
  KnobRegistry& knobs = session_.renderer->knobs();
  if (!automatic && knobs.find("lighting.exposure") != nullptr)
    static_cast<void>(knobs.set("lighting.exposure", "fixed"));
}

void PlayPanel::set_lens(float focus_m, float f_number) {
  World& world = session_.world;
  DepthOfField lens;
  if (const auto* old = std::as_const(world).try_get<DepthOfField>(session_.camera)) lens = *old;
  lens.focus_m = focus_m;
  lens.f_number = f_number;
  world.add<DepthOfField>(session_.camera, lens);
}

/// A pixel of the drawn picture, which may be smaller than the window.
void PlayPanel::pick(const WindowInput& input, const ViewSettings& view, double scale) {
  const auto pixel = pixel_at(view, {input.pointer_x, input.pointer_y, scale});
  if (!pixel) return;
  ++pick_;
  const auto lines = session_.renderer->pick(session_.world, view.id, pixel->x, pixel->y);
  picked_ = lines.ok() ? *lines : std::vector<std::string>{lines.error().message};
  const auto position = session_.renderer->pick_position(session_.world, view.id, pixel->x, pixel->y);
  picked_m_ = 0.0f;
  picked_place_ = {input.pointer_x, input.pointer_y};
  picked_position_.reset();
  if (!position.ok() || !*position) return;
  picked_position_ = **position;
  ViewSettings camera = view;
  if (camera.follow_camera) follow_camera(session_.world, camera);
  const dvec4 seen = glm::inverse(camera.world_from_camera) * dvec4(**position, 1.0);
  picked_m_ = static_cast<float>(-seen.z);
}

/// Marks of lights, and a cross at the pixel that was picked last; it stays on its surface when the camera moves.
std::vector<PanelMark> PlayPanel::marks(const ViewSettings& view) const {
  std::vector<PanelMark> marks = lights_.marks(view);
  if (picked_.empty()) return marks;
  const auto place = picked_position_ ? place_in_picture(view, *picked_position_) : std::optional(picked_place_);
  if (place) marks.push_back({.shape = PanelMark::Shape::cross, .from = *place, .color = {255, 255, 255}});
  return marks;
}

void PlayPanel::tell(std::string message, bool urgent) {
  notice_ = {std::move(message), urgent};
  shown_ |= urgent;
}

Status PlayPanel::write_config(const std::string& path) const {
  GLOAM_TRY(make_folder_of(path));
  return write_file(path, config_text(session_.renderer->knobs()));
}

void PlayPanel::save_config(const std::string& scene) {
  const std::string path = config_path(scene, "");
  const Status written = write_config(path);
  said_ = written.ok() ? "wrote " + path : written.error().message;
  unsaved_ = unsaved_ && !written.ok();
}

bool PlayPanel::may_leave(const std::string& scene) {
  if (!(unsaved_ || lights_.unsaved()) || asked_to_leave_) return true;
  asked_to_leave_ = true;
  tell("Changes are not saved. Escape again leaves and writes them to out/" + scene_stem(scene) + ".unsaved.*.json",
       true);
  return false;
}

void PlayPanel::keep_changes(const std::string& scene, LogSink& log) {
  if (lights_.unsaved()) log.info(lights_.save("out/" + scene_stem(scene) + ".unsaved.lights.json"));
  if (!unsaved_) return;
  const std::string path = config_path(scene, ".unsaved");
  const Status written = write_config(path);
  if (written.ok())
    log.info("wrote " + path + ": knobs that were changed and not saved");
  else
    log.warning(written.error().message);
  unsaved_ = false;
}

std::string PlayPanel::command_line(const PlayControls& controls, const ViewSettings& view) const {
  const std::string camera(session_.world.resource<SceneNames>().name_of(session_.camera));
  std::string line = "gloam render '" + controls.scene + "' --size " + std::to_string(view.width) + "x" +
                     std::to_string(view.height) + " --time " + formatted("%f", controls.time_s);
  if (!camera.empty()) line += " --camera '" + camera + "'";
  if (view.visualizer != "none") line += " --view '" + view.visualizer + "'";
  return line + assignments_text(session_.renderer->knobs());
}

void PlayPanel::set_scale(double scale) {
  if (scale == scale_) return;
  scale_ = scale;
  drawn_ = false;
  renderer_.reset();
  panel_.reset();
}

std::optional<vec2> PlayPanel::widget(std::string_view name) const {
  if (!drawn_) return std::nullopt;
  for (const PanelWidget& widget : panel_->widgets())
    if (widget.name == name) return 0.5f * vec2(widget.left + widget.right, widget.top + widget.bottom);
  return std::nullopt;
}

std::function<Status(FrameGraph&, ImageRef&)> PlayPanel::overlay() {
  if (!drawn_) return {};
  return
      [this](FrameGraph& graph, ImageRef& picture) { return renderer_->add_pass(graph, picture, panel_->draw_data()); };
}

}  // namespace gloam

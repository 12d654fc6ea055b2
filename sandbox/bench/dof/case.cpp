// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/bench/dof/case.h"

#include <span>

#include "engine/core/hash.h"
#include "engine/ecs/view.h"
#include "modules/depth_of_field/lens/lens.h"
#include "sandbox/bench/harness/measure.h"
#include "sandbox/session/loading/scene_loading.h"

namespace gloam {
namespace {

constexpr float kNearestFocus_m = 1e-3f;  // counts as that of the near plane (lens_of)

/// kNoEntity if no camera has a focus.
Result<Entity> camera_with_focus(const BenchContext& context, const Session& session) {
  Entity found = kNoEntity;
  if (!context.options().camera.empty()) {
    const auto named = find_camera(session.world, session.info, context.options().camera);
    if (!named) return named.error();
    const DepthOfField* values = session.world.try_get<DepthOfField>(*named);
    return values != nullptr && has_focus(*values) ? *named : kNoEntity;
  }
  session.world.view<const DepthOfField>().each([&](Entity entity, const DepthOfField& values) {
    if (found == kNoEntity && has_focus(values)) found = entity;
  });
  return found;
}

}  // namespace

Result<std::unique_ptr<DofFrames>> DofFrames::open(BenchContext& context, Bokeh bokeh) {
  auto session = context.open_builtin(context.scene_or(kLensScene));
  if (!session) return session.error();
  const auto camera = camera_with_focus(context, **session);
  if (!camera) return camera.error();
  if (*camera == kNoEntity) return std::unique_ptr<DofFrames>();
  std::unique_ptr<DofFrames> frames(new DofFrames(std::move(session).value()));
  frames->session_->camera = *camera;
  frames->settings_ = frames->session_->view_settings(context.options().width, context.options().height, "none");
  frames->focus_m_ = frames->lens().focus_m;
  frames->lens().bokeh = bokeh;
  return frames;
}

DepthOfField& DofFrames::lens() { return session_->world.get<DepthOfField>(session_->camera); }

Status DofFrames::set(std::string_view knob, std::string_view value) {
  return session_->renderer->knobs().set(knob, value);
}

void DofFrames::turn(bool on) { lens().focus_m = on ? focus_m_ : 0.0f; }

void DofFrames::blur_everything() {
  focus_m_ = kNearestFocus_m;
  lens().focus_m = kNearestFocus_m;
  lens().f_number = kLeastFNumber;
}

Result<FrameSample> DofFrames::draw() { return session_->render_frame({settings_, {}}); }

Result<LinearPicture> DofFrames::linear() { return session_->renderer->read_linear(settings_.id); }

Result<DofFrames*> DofFramesPool::get(BenchContext& context, Bokeh bokeh) {
  const auto found = opened_.find(bokeh);
  if (found != opened_.end()) return found->second.get();
  auto opened = DofFrames::open(context, bokeh);
  if (!opened) return opened.error();
  return opened_.emplace(bokeh, std::move(opened).value()).first->second.get();
}

DofTimes dof_times(const FrameSample& sample) {
  DofTimes times;
  for (const PassTime& pass : sample.report.passes) {
    if (pass.module != "depth_of_field") continue;
    const double ns = pass.ms * kNsPerMs;
    if (pass.name.starts_with("dof_tile_")) {
      times.tiles_ns += ns;
    } else if (pass.name == "dof_prefilter") {
      times.prefilter_ns += ns;
    } else if (pass.name == "dof_compose") {
      times.compose_ns += ns;
    } else {
      times.blur_ns += ns;
    }
  }
  return times;
}

std::uint64_t hash_of_dof_light(const LinearPicture& picture) {
  return hash_bytes(std::as_bytes(std::span(picture.rgba)));
}

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/session_costs.h"

#include <utility>

namespace gloam {

SessionCosts::SessionCosts(Session& session, const Options& options)
    : session_(session),
      options_(options),
      request_{.settings = session.view_settings(options.width, options.height, options.view), .target = {}} {}

std::vector<ReferenceInfo> SessionCosts::references() const {
  std::vector<ReferenceInfo> all;
  for (const auto& module : session_.renderer->modules()) {
    for (ReferenceInfo& reference : module->references()) all.push_back(std::move(reference));
  }
  return all;
}

Result<FrameCost> SessionCosts::draw(std::uint32_t index) {
  session_.set_clock(options_.time_s + index * options_.dt_s, options_.dt_s);
  const auto sample = session_.render_frame(request_);
  if (!sample) return sample.error();
  index_ = index;
  return FrameCost{.cpu_ms = sample->report.cpu_ms, .gpu_ms = sample->report.gpu_ms};
}

Result<std::uint64_t> SessionCosts::gpu_bytes() {
  session_.renderer->free_idle_memory();
  // The device frees when the frames that could still use it have passed.
  for (int frame = 0; frame < 3; ++frame) GLOAM_TRY(draw(index_));
  std::uint64_t bytes = 0;
  for (const ModuleState& module : session_.renderer->report().modules) bytes += module.gpu_bytes;
  return bytes;
}

Result<FramePictures> SessionCosts::read() {
  auto linear = session_.renderer->read_linear(request_.settings.id);
  if (!linear) return linear.error();
  auto picture = session_.renderer->read_picture(request_.settings.id);
  if (!picture) return picture.error();
  return FramePictures{.linear = std::move(linear).value(), .picture = std::move(picture).value()};
}

Result<FramePictures> SessionCosts::draw_reference(const ReferenceInfo& reference, const FramePictures& frame,
                                                   std::uint32_t samples) {
  return reference.draw({.world = session_.world,
                         .view = session_.world.view_resource<RenderView>(request_.settings.id),
                         .knobs = knobs(),
                         .frame = frame,
                         .samples = samples,
                         .executor = *session_.executor});
}

}  // namespace gloam

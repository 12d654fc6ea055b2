// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/declare/pass_frames.h"

namespace gloam {

PassFrames::PassFrames(gpu::Device& device, LogSink& log, const char* owner, const RenderView& view)
    : device_(device),
      pipelines_(device),
      uniforms_(device, owner, gpu::BufferUsage::uniform),
      storage_(device, owner, gpu::BufferUsage::storage | gpu::BufferUsage::transfer_source),
      results_(device),
      declared_(device),
      history_(device),
      graph_(device),
      view_(view),
      scene_(device, pipelines_),
      services_{.device = device,
                .executor = *executor_,
                .log = log,
                .knobs = knobs_,
                .pipelines = pipelines_,
                .uniforms = uniforms_,
                .storage = storage_,
                .results = results_,
                .declared = declared_,
                .history = history_} {
  draws_.views.resize(1);
}

PassFrames::~PassFrames() { static_cast<void>(device_.wait_idle()); }

FrameBuilder& PassFrames::begin() {
  uniforms_.begin_frame();
  storage_.begin_frame();
  results_.begin_frame();
  graph_.begin();
  declared_.recordings.begin_frame();
  declared_.due_pipelines.begin_frame();
  history_.begin_frame();
  shared_.clear();
  return frame_.emplace(services_, graph_, world_, view_, scene_, draws_, 0, shared_);
}

Status PassFrames::compile() {
  GLOAM_TRY(frame_->status());
  GLOAM_TRY(declared_.due_pipelines.make_all(pipelines_, *executor_, nullptr));
  return graph_.compile();
}

Status PassFrames::record(gpu::CommandList& commands) {
  graph_.execute(commands);
  return graph_.recorded();
}

Status PassFrames::record(gpu::CommandList& commands, const std::function<void(FrameBuilder&)>& declare) {
  declare(begin());
  GLOAM_TRY(compile());
  return record(commands);
}

}  // namespace gloam

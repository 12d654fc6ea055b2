// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "engine/frame/frame_graph.h"
#include "engine/frame/history.h"
#include "engine/frame/transfers/results.h"
#include "engine/frame/transfers/upload.h"
#include "engine/render/camera/camera_cuts.h"
#include "engine/render/declare/recording.h"
#include "engine/render/draws/motion_history.h"
#include "engine/render/pipelines/pipelines.h"

namespace gloam {

/// The objects that frames use one after another: graph, upload rings, results, histories and pipelines. Each of them
/// treats a frame as a transaction; the functions here keep them in step.
struct FrameResources {
  explicit FrameResources(gpu::Device& device);
  FrameResources(const FrameResources&) = delete;
  FrameResources& operator=(const FrameResources&) = delete;

  /// After Device::begin_frame and before the frame is declared.
  void begin_frame();
  /// Ends a submitted frame of this world. redraw: it has drawn the world's last frame again.
  void commit(World& world, bool redraw);
  /// Ends a frame that the GPU does not execute.
  void give_up_frame();

  void forget_world(std::uint64_t world);
  void forget_view(ViewId view);
  /// Frees results and histories of a module, not its pipelines.
  void forget_module(std::string_view module);
  /// Frees the memory that all views of a frame share: transient, staging and that of placeholders. No frame may be in
  /// flight.
  void free_memory();

  /// Frees staging memory; the next frame takes what it needs. No frame may be in flight.
  void free_staging() { make_rings(); }

  Pipelines pipelines;
  std::optional<UploadRing> uniforms;
  std::optional<UploadRing> storage;
  FrameResults results;
  declare::State declared;
  MotionHistory motion;
  History history;
  CameraCuts cuts;
  FrameGraph graph;

 private:
  void make_rings();

  gpu::Device& device_;
};

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// Reuse of light (lighting.reuse=exact): shadow tiles of which nothing has changed since they were lit keep that light,
// bit for bit. The GPU compares a hash of all that deferred lighting reads for a tile
// (shaders/lighting/opaque/lit_tiles.comp.glsl). In frames in which something has changed for all tiles, such as the
// camera, nothing is compared or kept.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string_view>
#include <utility>

#include "engine/frame/frame_graph.h"
#include "engine/gpu/types.h"
#include "engine/render/frame_builder.h"
#include "engine/render/scene/draw_pipelines.h"
#include "modules/lighting/environment.h"
#include "modules/shadows/outputs.h"
#include "shaders/lighting/lit_tiles_shared.h"

namespace gloam {

/// Name of the frame result that holds a LitTileCommands.
inline constexpr std::string_view kLitTilesResult = "lit_tiles";

/// The light that a view keeps, and what must be drawn of it.
struct KeptLight {
  ImageRef light;        ///< of the view's size, in the format of LitOutput
  BufferRef tiles;       ///< a flag for each tile, then runs of changed tiles (lit_tiles_shared.h)
  BufferRef commands;    ///< one LitTileCommands
  std::uint64_t inputs;  ///< hash of what all tiles are lit by
  bool filled = false;   ///< the image holds light of an earlier frame
};

/// What is known of the last frames of all views.
class LightReuse {
 public:
  /// Whether the view's last frame had these inputs, so that tiles may keep light. Notes them. While too many tiles
  /// change it says no, but tries again now and then. frame: Device::frame_number.
  [[nodiscard]] bool may_keep(std::uint64_t world, ViewId view, std::uint64_t inputs, std::uint64_t frame);
  /// Of a frame that has compared tiles.
  void note_result(std::uint64_t world, ViewId view, const shaders::LitTileCommands& result);
  void release_view(ViewId view);
  void release() { views_.clear(); }

 private:
  struct View {
    std::uint64_t inputs = 0;
    std::uint64_t last_use = 0;
    std::uint32_t pause = 0;  ///< frames in which nothing is compared
  };
  std::map<std::pair<std::uint64_t, std::uint32_t>, View> views_;
};

/// The view's kept light, if this frame can use it: it has final lists, the same inputs as the last frame, and the
/// pipelines. constants: those of the lighting program.
[[nodiscard]] std::optional<KeptLight> plan_kept_light(FrameBuilder& frame, const ShadingInputs& inputs,
                                                       const ShadowsOutputs& shadows,
                                                       const gpu::SpecConstants& constants,
                                                       const PipelineList& pipelines, LightReuse& reuse);
/// Finds the tiles that have changed; fills `kept.commands` and `kept.tiles`.
void add_lit_tiles_pass(FrameBuilder& frame, const ShadingInputs& inputs, const ShadowsOutputs& shadows,
                        KeptLight& kept);
/// Copies the light into an image of its size and format, which later passes may change.
[[nodiscard]] ImageRef add_kept_light_copy(FrameBuilder& frame, const KeptLight& kept, ImageRef to);
/// Appends the pipelines that find changed tiles.
void list_kept_light_pipelines(const ShadingInputs& inputs, const ShadowsOutputs& shadows, PipelineList& list);

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "engine/render/declare/compute_pass.h"
#include "engine/render/declare/draw_pass.h"
#include "engine/render/draws/caster_source.h"
#include "modules/grass/frame.h"

namespace gloam {

[[nodiscard]] ComputeProgram grass_pose_program();
/// What selects the pipelines that draw blades into the geometry buffer.
struct BladeVersion {
  bool motion = false;    ///< into frames with GeometryOutputs::motion
  bool clipped = false;   ///< of a view with a clip plane
  bool textured = false;  ///< a surface of the world has an image of blades
};
/// Draws one class of blades into the geometry buffer.
[[nodiscard]] DrawProgram blade_program(std::uint32_t draw_class, const BladeVersion& version);
[[nodiscard]] CasterProgram blade_caster_program();

/// Pipelines that draw the blades.
void list_blade_pipelines(const BladeVersion& version, PipelineList& list);
/// Whether the pipelines of the view's kind exist, or the frame waits for them. Otherwise they are requested.
[[nodiscard]] bool blade_pipelines_ready(const FrameBuilder& frame);

/// Computes the poses of the live blades, and lists those that cast shadows. Leaves out draws and indices.
[[nodiscard]] DrawnBlades add_pose_pass(FrameBuilder& frame, const GrassInputs& inputs, const GrassStore& store,
                                        const SortedBlades& sorted);
/// Draws the live blades into the geometry buffer. store: after the simulation. posed: add_pose_pass().
[[nodiscard]] DrawnBlades add_blade_pass(FrameBuilder& frame, const GrassInputs& inputs, const GrassStore& store,
                                         const SortedBlades& sorted, DrawnBlades posed);
/// Binds all that blade_shape.glsl reads.
void bind_blades(ShaderPass& pass, const DrawnBlades& blades);

/// The blades near the camera that cast shadows.
struct CastingBlades {
  WorldBox bounds;
  std::uint32_t turns = 1;    ///< CasterSource::turns
  std::uint64_t content = 0;  ///< while they move: of what they are besides their movement
  std::uint64_t most = 0;     ///< blades of the patches that they are of
  std::uint64_t rest = 0;     ///< rest_inputs() if all of them rest; 0: they may move
};
/// Adds them as a caster of shadows, in PassPhase::announce. `grass` is set later in the frame, before shadow maps are
/// drawn.
void add_blade_casters(FrameBuilder& frame, std::shared_ptr<const GrassFrame> grass, const CastingBlades& casting);

}  // namespace gloam

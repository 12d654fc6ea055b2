// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "engine/render/declare/shader_pass.h"

namespace gloam {

/// A fragment shader with its vertex shader, constants and fixed state. Draws have no vertex streams.
struct DrawProgram {
  gpu::ShaderCode fragment;
  gpu::SpecConstants constants = {};
  gpu::BlendMode blend = gpu::BlendMode::opaque;
  /// With a depth target: the test of the fragment's depth against the stored one.
  gpu::CompareOp depth_compare = gpu::CompareOp::greater_equal;
  gpu::ShaderCode vertex = {};               ///< no words: one full-screen triangle at depth 0 (fullscreen.vert)
  bool depth_write = false;                  ///< only with DrawPass::depth_target
  gpu::CullMode cull = gpu::CullMode::none;  ///< front faces are counter-clockwise in the picture
};
/// For Module::pipelines. colors: formats of the colour targets. depth: format of the depth target, or undefined.
[[nodiscard]] gpu::GraphicsPipelineDesc pipeline_desc(const DrawProgram& program, std::string_view module,
                                                      std::span<const gpu::Format> colors,
                                                      gpu::Format depth = gpu::Format::undefined);

/// A pass that draws into images: full-screen triangles, lists of surfaces, indirect draws. See ShaderPass for
/// bindings. The rendered area is the whole first target (its mip). Targets must be declared before the first draw.
class DrawPass : public ShaderPass {
 public:
  DrawPass(FrameBuilder& frame, std::string_view name);
  DrawPass(FrameBuilder& frame, std::string_view name, const DrawProgram& program) : DrawPass(frame, name) {
    use(program);
  }

  /// Adds the next colour target. Returns the version that later passes read. load: `load` keeps the content or blends
  /// over it; `clear` sets zeros; `discard`: the draws cover every pixel.
  [[nodiscard]] ImageRef target(ImageRef image, gpu::LoadOp load = gpu::LoadOp::discard, std::uint32_t mip = 0,
                                std::uint32_t layer = 0);
  /// A depth image that is tested and written. clear: to 0 (reversed depth: infinitely far).
  [[nodiscard]] ImageRef depth_target(ImageRef image, gpu::LoadOp load);
  /// A depth image that is only tested. The pass may also bind it.
  void test_depth(ImageRef image);

  /// Later draws use this program.
  void use(const DrawProgram& program);
  /// Later surfaces() are drawn with this pass's fragment shader. Its formats must be those of the targets.
  void use(const SurfacePass& surfaces);

  /// One full-screen triangle.
  void draw_triangle() { draw(3, 1); }
  void draw(std::uint32_t vertices, std::uint32_t instances);
  /// One non-indexed draw with arguments from a buffer (CommandList::draw_indirect). offset: bytes.
  void draw_indirect(BufferRef arguments, std::uint64_t offset);
  /// Several draws without vertex streams: gl_VertexIndex comes from `indices` (32 bits). The arguments are those of
  /// CommandList::draw_indexed_indirect. offset: bytes.
  void draw_indexed_indirect(BufferRef indices, BufferRef arguments, std::uint64_t offset, std::uint32_t draws);
  /// Draws meshes. `draws` must live until the frame is submitted, as those of FrameBuilder::draws().
  /// commands: shaders::ClusterCommand for each of ViewDraws::clusters, in place of the indices of `draws`; null: none.
  void surfaces(std::span<const Draw> draws, BufferRef commands = {});

 private:
  [[nodiscard]] bool choose_pipeline();
  DrawProgram program_;
};

/// Declares the images of the geometry buffer as targets of a pass in PassPhase::geometry: base_color, normals,
/// material, emissive, then motion if it is not null, and depth. Their contents are kept. The program must have
/// depth_compare greater_equal and depth_write. The fragment shader must write every colour target, as
/// gbuffer_api.glsl describes. Only frames with motion have the target at location 4, so a module needs a fragment
/// shader for each case.
void geometry_targets(DrawPass& pass, GeometryOutputs& geometry);
/// Formats of the colour targets that geometry_targets declares, for pipeline_desc.
[[nodiscard]] std::span<const gpu::Format> geometry_formats(bool motion);
inline constexpr gpu::Format kGeometryDepthFormat = gpu::Format::d32_float;

/// Uploads the constants of motion_api.glsl as the binding "motion", if the program in use declares it.
void bind_motion(DrawPass& pass, const RenderView& view);

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// Casters without a mesh: a module draws their triangles into shadow maps itself, with its own shaders. The module adds
// its sources in PassPhase::announce (FrameBuilder::add_caster_source). The shadows module culls and caches them like
// meshes and calls them for the faces that they may be seen in.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "engine/ecs/entity.h"
#include "engine/frame/frame_graph.h"
#include "engine/gpu/types.h"
#include "engine/math/types.h"
#include "engine/render/packing/caster_bounds.h"
#include "shaders/render/caster_shared.h"

namespace gloam {

/// Format of the depth images that casters are drawn into. Depth is reversed: 1 is nearest.
inline constexpr gpu::Format kCasterDepthFormat = gpu::Format::d32_float;

/// Shaders and vertex streams that draw casters, depth only.
struct CasterProgram {
  gpu::ShaderCode vertex;
  gpu::ShaderCode fragment = {};  ///< no words: none. It may discard fragments, and has no outputs
  gpu::SpecConstants constants = {};
  std::vector<gpu::VertexAttribute> attributes = {};
  std::vector<std::uint32_t> stream_strides = {};  ///< bytes, one per vertex stream
  /// A culled side casts no shadow. Sheets without thickness need `none`.
  gpu::CullMode cull = gpu::CullMode::none;
};
/// The pipeline of a program, with the depth format, depth test and depth bias of map drawing. For Module::pipelines
/// and Pipelines::get.
[[nodiscard]] gpu::GraphicsPipelineDesc caster_pipeline_desc(const CasterProgram& program, std::string_view module);

/// The projection of one face of a map.
struct CasterProjection {
  dvec3 origin = dvec3(0.0);              ///< world: the light, or the middle of an orthographic face's near side
  dmat4 clip_from_relative = dmat4(1.0);  ///< from world axes relative to `origin`
  bool orthographic = false;

  /// The transform of positions that `world_from_local` (affine) takes to the world. Composed in double, so that it is
  /// exact far from the world's origin too, if the positions are near `origin`.
  [[nodiscard]] mat4 clip_from(const dmat4& world_from_local) const;
  /// The same for shaders/render/caster_api.glsl.
  [[nodiscard]] shaders::CasterConstants constants(const dmat4& world_from_local) const {
    return {clip_from(world_from_local), orthographic ? 1u : 0u};
  }
};

class FrameBuilder;

/// A part of a face that a source will be drawn into, for CasterSource::prepare.
struct CasterSourcePart {
  CasterProjection projection;
  vec4 clip = vec4(-1.0f, -1.0f, 1.0f, 1.0f);  ///< least x and y, greatest x and y of the part in clip space, over w
  float reach_m = 0.0f;  ///< surfaces farther than this from the projection's origin cast nothing; 0: no limit
};

/// One face, or part of a face, that a source is being drawn into.
class CasterSourceDraw {
 public:
  /// bias_units, bias_slope: as in CommandList::set_depth_bias.
  /// part: see part().
  CasterSourceDraw(PassContext& context, const CasterProjection& projection, std::uint32_t face_size, float bias_units,
                   float bias_slope, std::uint32_t part)
      : context_(context),
        projection_(projection),
        face_size_(face_size),
        bias_units_(bias_units),
        bias_slope_(bias_slope),
        part_(part) {}

  [[nodiscard]] PassContext& context() const { return context_; }
  [[nodiscard]] const CasterProjection& projection() const { return projection_; }
  /// Texels of the face's side. Parts of a face have the projection and the size of the whole face, and the triangles
  /// must be the same in all of them.
  [[nodiscard]] std::uint32_t face_size() const { return face_size_; }
  /// The map's depth bias, for pipelines of the host (gpu::native_commands): the first and the last factor of
  /// vkCmdSetDepthBias. Negative, because depth is reversed.
  [[nodiscard]] float bias_units() const { return bias_units_; }
  [[nodiscard]] float bias_slope() const { return bias_slope_; }
  /// Index of the part by CasterSource::prepare; kNoPart: the part has not been prepared.
  [[nodiscard]] std::uint32_t part() const { return part_; }
  static constexpr std::uint32_t kNoPart = ~0u;
  /// Binds a pipeline of caster_pipeline_desc() with the map's depth bias.
  void bind_pipeline(gpu::PipelineHandle pipeline) const;

 private:
  PassContext& context_;
  const CasterProjection& projection_;
  std::uint32_t face_size_;
  float bias_units_;
  float bias_slope_;
  std::uint32_t part_;
};

/// Triangles that cast shadows and belong to no mesh. A source that no light's face may see is neither declared nor
/// recorded.
struct CasterSource {
  /// Set if the source completes the meshes of an entity and lies within their bounds: maps that leave out or select
  /// the entity's casters then treat the source alike.
  Entity entity = kNoEntity;
  /// Encloses all triangles in this frame; the unknown box: they may be anywhere. Maps are redrawn only inside the
  /// bounds that changed.
  WorldBox bounds;
  /// Of everything that the triangles depend on, or a number that the host raises with each change. Cached maps stay
  /// valid while hash, bounds and entity stay the same. 0: not known; the source then counts as moving, without turns.
  std::uint64_t content_hash = 0;
  /// The triangles differ from frame to frame, and content_hash is ignored. Faces that see the source are redrawn every
  /// frame inside its bounds; the depth of resting casters is taken from the cache.
  bool moving = false;
  /// Of a moving source: it is redrawn in every turns-th frame only, each face in a frame of its own, as long as
  /// content_hash is the same. Where another caster moves, the source is redrawn with it. ≥ 1.
  std::uint32_t turns = 1;
  /// Adds passes that prepare the source for these parts of faces, e.g. lists of what each of them sees, and returns
  /// the index of the first part. Called before declare_reads, any number of times a frame. May be empty.
  std::function<std::uint32_t(FrameBuilder&, std::span<const CasterSourcePart>)> prepare;
  /// Declares what `record` reads, e.g. buffers that earlier passes of the frame write. Called once for each pass that
  /// draws maps, if any face of the frame draws the source. May be empty.
  std::function<void(PassBuilder&)> declare_reads;
  /// Records the draws of all triangles. Called several times a frame, inside a pass that is rendering: viewport,
  /// scissor and target are set and must not change. A host may record with pipelines and buffers that are unknown to
  /// gloam (gpu::native_commands). Not empty.
  std::function<void(const CasterSourceDraw&)> record;

  /// Whether nothing drawn from the source may be kept for the next frame.
  [[nodiscard]] bool changes_every_frame() const { return moving || content_hash == 0; }
};

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "native_casters.h"

#include <glm/ext/matrix_transform.hpp>
#include <utility>

#include "engine/render/draws/caster_source.h"
#include "engine/render/frame_builder.h"
#include "shaders/native/shaders.h"

namespace host {

using namespace gloam;

SkinnedMesh SkinnedMesh::column(const vec3& foot, float height_m, float half_m, std::uint32_t rings) {
  SkinnedMesh mesh;
  for (std::uint32_t ring = 0; ring < rings; ++ring) {
    const float share = static_cast<float>(ring) / static_cast<float>(rings - 1);
    for (const vec2 corner : {vec2(-1.0f, -1.0f), vec2(1.0f, -1.0f), vec2(1.0f, 1.0f), vec2(-1.0f, 1.0f)})
      mesh.rest.emplace_back(foot + vec3(corner.x * half_m, share * height_m, corner.y * half_m), share);
  }
  for (std::uint32_t ring = 0; ring + 1 < rings; ++ring)
    for (std::uint32_t side = 0; side < 4; ++side) {
      const std::uint32_t a = 4 * ring + side, b = 4 * ring + (side + 1) % 4;
      for (const std::uint32_t index : {a, a + 4, b, b, a + 4, b + 4}) mesh.indices.push_back(index);
    }
  return mesh;
}

void SkinnedMesh::bend(float radians) {
  const vec3 middle = 0.5f * (vec3(rest.front()) + vec3(rest[rest.size() - 2]));
  bones[1] = glm::translate(glm::rotate(glm::translate(mat4(1.0f), middle), radians, vec3(0.6f, 0.0f, 0.8f)), -middle);
}

std::vector<vec3> SkinnedMesh::posed() const {
  std::vector<vec3> positions;
  for (const vec4& vertex : rest) {
    const vec4 at(vec3(vertex), 1.0f);
    positions.push_back(glm::mix(vec3(bones[0] * at), vec3(bones[1] * at), vertex.w));
  }
  return positions;
}

WorldBox SkinnedMesh::bounds(double margin_m) const {
  WorldBox box;
  for (const vec3& position : posed()) {
    box.min = glm::min(box.min, dvec3(position) - margin_m);
    box.max = glm::max(box.max, dvec3(position) + margin_m);
  }
  return box;
}

WorldBox bounds_of(std::span<const vec4> cubes) {
  WorldBox box;
  for (const vec4& cube : cubes) {
    box.min = glm::min(box.min, dvec3(vec3(cube) - cube.w));  // in floats, as the shader adds
    box.max = glm::max(box.max, dvec3(vec3(cube) + cube.w));
  }
  return box;
}

namespace {

class NativeCasters final : public Module {
 public:
  NativeCasters(const NativeDrawing& drawing, const SkinnedMesh& mesh, const Cubes& cubes, NativeCounts& counts)
      : drawing_(drawing), mesh_(mesh), cubes_(cubes), counts_(counts) {}

  [[nodiscard]] std::string_view name() const override { return "native_casters"; }
  void register_components(World&) const override {}
  void scene_keys(KeyRegistry&) const override {}
  [[nodiscard]] Demand demand(const World&, const RenderView*) const override { return {true, "the host's casters"}; }
  void add_passes(FrameBuilder& frame, PassPhase phase) override {
    if (phase == PassPhase::lists && counts_.works) work(frame.graph());
    if (phase != PassPhase::announce) return;
    frame.add_caster_source(mesh_source());
    frame.add_caster_source(cube_source());
  }

 private:
  [[nodiscard]] CasterSource mesh_source() {
    CasterSource source;
    source.bounds = mesh_.bounds();
    source.content_hash = mesh_.revision;
    source.prepare = [this](FrameBuilder& frame, std::span<const CasterSourcePart>) {
      skin(frame.graph());
      return CasterSourceDraw::kNoPart;
    };
    source.declare_reads = [this](PassBuilder& pass) { pass.read(posed_, gpu::Access::vertex_input); };
    source.record = [this](const CasterSourceDraw& draw) {
      ++counts_.mesh_draws;
      const gpu::NativeCommands native = gpu::native_commands(draw.context().commands());
      if (native.get() != VK_NULL_HANDLE) drawing_.record_mesh(native.get(), face_of(draw));
    };
    return source;
  }
  [[nodiscard]] CasterSource cube_source() {
    CasterSource source;
    source.bounds = bounds_of(cubes_);
    source.content_hash = 1;  // they never change
    source.record = [this](const CasterSourceDraw& draw) {
      ++counts_.cube_draws;
      const gpu::NativeCommands native = gpu::native_commands(draw.context().commands());
      if (native.get() != VK_NULL_HANDLE) drawing_.record_cubes(native.get(), face_of(draw));
    };
    return source;
  }
  /// Adds a pass whose commands do nothing here.
  void work(FrameGraph& graph) {
    PassBuilder pass = graph.add_pass("host_work", name());
    pass.keep();  // gloam does not know what it writes
    pass.execute([this](PassContext& context) {
      const gpu::NativeCommands native = gpu::native_commands(context.commands(), counts_.revision);
    });
  }
  [[nodiscard]] static NativeDrawing::Face face_of(const CasterSourceDraw& draw) {
    return {draw.projection().constants(dmat4(1.0)), draw.bias_units(), draw.bias_slope()};
  }
  /// Adds the pass that poses the mesh, once a frame. gloam places the barriers between it, the draws of this frame and
  /// those of the frame before.
  void skin(FrameGraph& graph) {
    if (frame_ == graph.frame()) return;
    frame_ = graph.frame();
    const BufferRef before =
        graph.import_buffer("posed", drawing_.posed(), gpu::Access::vertex_input, gpu::Access::vertex_input);
    PassBuilder pass = graph.add_pass("skin", name());
    posed_ = pass.write(before, gpu::Access::compute_write);
    pass.execute([this](PassContext& context) {
      ++counts_.skinned;
      const gpu::NativeCommands native = gpu::native_commands(context.commands());
      if (native.get() != VK_NULL_HANDLE) drawing_.record_skinning(native.get(), mesh_.bones);
    });
  }

  const NativeDrawing& drawing_;
  const SkinnedMesh& mesh_;
  const Cubes& cubes_;
  NativeCounts& counts_;
  std::uint32_t frame_ = 0;  ///< FrameGraph::frame of posed_
  BufferRef posed_;
};

}  // namespace

std::unique_ptr<Module> make_native_casters(const NativeDrawing& drawing, const SkinnedMesh& mesh, const Cubes& cubes,
                                            NativeCounts& counts) {
  return std::make_unique<NativeCasters>(drawing, mesh, cubes, counts);
}

}  // namespace host

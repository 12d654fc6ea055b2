// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "engine/core/result.h"
#include "engine/frame/upload.h"
#include "engine/gpu/device.h"
#include "engine/jobs/executor.h"
#include "engine/render/scene/draw_pipelines.h"
#include "engine/render/scene/mesh_packing.h"
#include "engine/scene/assets.h"

namespace gloam {

/// Ranges of a primitive in the scene's buffers, and the data with which the CPU culls and deforms it.
struct GpuPrimitive {
  std::uint32_t material = 0;  ///< index into GpuScene::materials()
  std::uint32_t vertex_count = 0;
  std::uint32_t first_vertex = 0;  ///< a multiple of 64, so that the byte offset of every stream is aligned for binding
  std::uint32_t first_index = 0;
  std::uint32_t index_count = 0;
  std::uint32_t simplified_first_index = 0;
  std::uint32_t simplified_index_count = 0;  ///< 0: the full indices cast its shadow (GpuScene::simplify_casters)
  std::uint32_t first_influence = 0;         ///< a multiple of 64
  std::uint32_t first_morph = 0;             ///< index of a float, a multiple of 64
  std::uint32_t morph_targets = 0;
  bool morph_has_normals = false;
  bool skinned = false;
  bool colored = false;        ///< has vertex colours
  bool closed = false;         ///< is_closed_surface()
  bool smooth_shaded = false;  ///< is_smooth_shaded(), in the rest pose
  Aabb bounds;
  std::vector<Cluster> clusters;
  /// Joint index and rest bounds of the vertices that follow the joint. The union of the posed boxes bounds the posed
  /// surface.
  std::vector<std::pair<std::uint32_t, Aabb>> joint_bounds;
  std::vector<Aabb> morph_bounds;  ///< bounds of the offsets of each target
};

struct GpuMaterial {
  gpu::ResourceSetHandle set;
  std::uint32_t features = 0;  ///< GLOAM_SURFACE_…
  AlphaMode alpha_mode = AlphaMode::opaque;
  bool double_sided = false;
  bool subsurface = false;
  bool emissive = false;
};

/// Pipeline variant that draws a primitive with a material. `flipped`: its front faces are clockwise.
[[nodiscard]] SurfaceVariant surface_variant(const GpuMaterial& material, const GpuPrimitive& primitive, bool flipped);

/// Meshes, textures and materials of a world's SceneAssets on the GPU.
class GpuScene {
 public:
  GpuScene(gpu::Device& device, Pipelines& pipelines) : device_(device), pipelines_(pipelines) {}
  ~GpuScene() { release(); }
  GpuScene(const GpuScene&) = delete;
  GpuScene& operator=(const GpuScene&) = delete;

  /// Uploads everything if assets.version is not the version uploaded last, and then waits for the GPU.
  [[nodiscard]] Status sync(const SceneAssets& assets, JobExecutor& executor);

  /// Gives opaque rigid primitives a second range of indices with fewer triangles (simplified_casters.h), once after
  /// each upload; replaces the buffer indices(). `assets`: those of the last sync. Waits for the GPU. Must not be
  /// called between begin_frame and submit_frame.
  [[nodiscard]] Status simplify_casters(const SceneAssets& assets, JobExecutor& executor);

  [[nodiscard]] const std::vector<std::vector<GpuPrimitive>>& meshes() const { return meshes_; }
  [[nodiscard]] const std::vector<GpuMaterial>& materials() const { return materials_; }
  /// Whether any primitive is smooth-shaded.
  [[nodiscard]] bool has_smooth_shading() const { return smooth_shading_; }

  [[nodiscard]] gpu::BufferHandle positions() const { return buffers_[0]; }
  [[nodiscard]] gpu::BufferHandle frames() const { return buffers_[1]; }
  [[nodiscard]] gpu::BufferHandle surfaces() const { return buffers_[2]; }
  [[nodiscard]] gpu::BufferHandle indices() const { return buffers_[3]; }
  [[nodiscard]] gpu::BufferHandle influences() const { return buffers_[4]; }
  [[nodiscard]] gpu::BufferHandle morph_offsets() const { return buffers_[5]; }

 private:
  struct Streams;
  void release();
  [[nodiscard]] Status upload_meshes(const SceneAssets& assets, JobExecutor& executor, Uploader& uploader);
  [[nodiscard]] Status upload_textures(const SceneAssets& assets, Uploader& uploader);
  [[nodiscard]] Status replace_indices(std::vector<std::byte> bytes, JobExecutor& executor);
  /// Adds a white texture of one texel, for material slots without a texture.
  [[nodiscard]] Status add_white_texel(Uploader& uploader);
  [[nodiscard]] Status upload_materials(const std::vector<Material>& sources, Uploader& uploader);
  [[nodiscard]] Status make_material_sets(const SceneAssets& assets, const std::vector<Material>& sources);
  [[nodiscard]] Result<gpu::ResourceSetHandle> material_set(const SceneAssets& assets, const Material& material,
                                                            std::uint32_t index, gpu::PipelineHandle like);

  gpu::Device& device_;
  Pipelines& pipelines_;
  std::uint64_t version_ = 0;
  /// Numbers of meshes, materials, textures and images. Assets that were added are uploaded without a new version.
  using Sizes = std::array<std::size_t, 4>;
  Sizes sizes_{};
  bool smooth_shading_ = false;
  bool casters_simplified_ = false;  ///< simplify_casters has run for version_
  std::vector<std::vector<GpuPrimitive>> meshes_;
  std::vector<GpuMaterial> materials_;
  std::array<gpu::BufferHandle, 6> buffers_{};
  gpu::BufferHandle material_constants_;
  std::vector<gpu::ImageHandle> images_;
  std::vector<gpu::ImageHandle> textures_;  ///< of images_, by texture index; the last one is a white texel
};

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "engine/core/result.h"
#include "engine/ecs/world.h"
#include "engine/frame/frame_graph.h"
#include "engine/frame/transfers/upload.h"
#include "engine/gpu/device.h"
#include "engine/jobs/executor.h"
#include "engine/render/packing/gpu_primitive.h"
#include "engine/render/packing/refined_triangles.h"
#include "engine/render/scene/asset_use.h"
#include "engine/render/scene/draw_pipelines.h"
#include "engine/render/scene/gpu_materials.h"
#include "engine/render/uploads/asset_packer.h"
#include "engine/render/uploads/asset_uploads.h"
#include "engine/render/uploads/mesh_streams.h"
#include "engine/scene/assets.h"

namespace gloam {

/// Pipeline variant that draws a primitive with a material. `flipped`: its front faces are clockwise.
[[nodiscard]] SurfaceVariant surface_variant(const GpuMaterial& material, const GpuPrimitive& primitive, bool flipped);

/// How changes of single assets are uploaded.
struct AssetUploadOptions {
  /// false: a frame shows all changes before it. true: another thread packs changed meshes and images, frames upload at
  /// most `budget` bytes of them, and until an asset is complete its earlier state is drawn, or nothing of a mesh and
  /// white for an image.
  bool background = false;
  std::uint64_t budget = std::uint64_t{8} << 20;
};

/// Meshes, textures and materials of a world's SceneAssets on the GPU. Meshes and images that are not in use (AssetUse)
/// are not there.
///
/// When SceneAssets::version has changed, sync() uploads everything and waits for it. Otherwise only the assets with a
/// newer revision are packed and copied by the frame itself, in the pass that add_pass() declares.
class GpuScene {
 public:
  GpuScene(gpu::Device& device, Pipelines& pipelines, const AssetUploadOptions& options = {})
      : device_(device), options_(options), streams_(device), materials_(device, pipelines), uploads_(device) {}
  ~GpuScene() { release(); }
  GpuScene(const GpuScene&) = delete;
  GpuScene& operator=(const GpuScene&) = delete;

  /// Before Device::begin_frame: uploads everything, or finds what has changed. Asserts that what is uploaded can be
  /// drawn (asset_fault). in_use: none if every mesh and every texture is in use.
  [[nodiscard]] Status sync(const SceneAssets& assets, JobExecutor& executor, std::optional<MeshesInUse> in_use = {});
  /// Gives opaque rigid primitives a second range of indices with fewer triangles (simplified_casters.h), each once.
  /// `assets`: those of the last sync. Between sync() and stage().
  [[nodiscard]] Status simplify_casters(const SceneAssets& assets, JobExecutor& executor);
  /// Gives opaque primitives their levels for this use (packing/make_levels.h), each once. As simplify_casters().
  [[nodiscard]] Status make_levels(const SceneAssets& assets, JobExecutor& executor, LevelUse use);
  /// Splits triangles that are too large for their distance from an eye (refined_triangles.h), for the instances of
  /// this frame. eyes: in the world, of all views. nearest: nothing nearer to an eye is drawn. `world`: with the assets
  /// of the last sync. Between sync() and stage().
  void split_large_triangles(const World& world, std::span<const dvec3> eyes, double nearest);
  /// The primitive that is drawn for an instance in place of one of its mesh; null: that one itself.
  [[nodiscard]] const GpuPrimitive* split_primitive(Entity instance, std::uint32_t primitive) const;
  /// After Device::begin_frame and before draws are made: decides what this frame copies, and shows what is complete.
  [[nodiscard]] Status stage(const SceneAssets& assets);
  /// Declares the pass `upload_assets` with the copies that stage() has decided on; none if there are none.
  void add_pass(FrameGraph& graph);
  /// The GPU does not execute this frame. If it had copies, the next sync() uploads everything.
  void give_up_frame();
  void commit_frame() { copies_ = false; }

  [[nodiscard]] const std::vector<std::vector<GpuPrimitive>>& meshes() const { return meshes_; }
  /// The material of a primitive; the default one for kNone.
  [[nodiscard]] const GpuMaterial& material(std::uint32_t index) const { return materials_.get(index); }
  /// Whether any primitive is smooth-shaded.
  [[nodiscard]] bool has_smooth_shading() const { return smooth_primitives_ > 0; }
  /// Meshes and images that are not shown as they are in SceneAssets yet.
  [[nodiscard]] std::size_t pending() const;

  [[nodiscard]] gpu::BufferHandle positions() const { return streams_.buffer(MeshStreams::positions); }
  [[nodiscard]] gpu::BufferHandle frames() const { return streams_.buffer(MeshStreams::frames); }
  [[nodiscard]] gpu::BufferHandle surfaces() const { return streams_.buffer(MeshStreams::surfaces); }
  [[nodiscard]] gpu::BufferHandle indices() const { return streams_.buffer(MeshStreams::indices); }
  [[nodiscard]] gpu::BufferHandle influences() const { return streams_.buffer(MeshStreams::influences); }
  [[nodiscard]] gpu::BufferHandle morph_offsets() const { return streams_.buffer(MeshStreams::morph_offsets); }

 private:
  /// Of one mesh or image.
  static constexpr std::uint64_t kNever = ~0ull;
  struct Progress {
    std::uint64_t requested = kNever;  ///< revision that is packed, copied or shown
    std::uint64_t shown = kNever;
    bool in_flight = false;
  };
  /// A primitive of an instance that may have triangles to split.
  struct Split {
    GpuPrimitive primitive;
    std::uint32_t mesh = 0;
    std::uint64_t revision = 0;
    dmat4 world_from_mesh = dmat4(1.0);
    double nearest = 0.0;                        ///< SeenFrom::nearest
    std::vector<std::pair<dvec3, double>> eyes;  ///< and how far they may move before it is looked at again
    bool split = false;                          ///< false: no triangle is too long, and `primitive` is empty
    bool used = false;
    [[nodiscard]] bool serves(const SeenFrom& seen) const;
  };
  void split(const Primitive& source, std::uint32_t mesh, const SeenFrom& seen, std::uint64_t revision, Split& made);
  void keep_whole(std::uint32_t mesh, const SeenFrom& seen, std::uint64_t revision, double slack, Split& made);
  /// A mesh or an image whose copies are being staged.
  struct Staged {
    PackedAsset asset;  ///< without the data that was given to the uploads
    gpu::ImageHandle image;
  };
  static constexpr std::uint64_t kNoAsset = 0;  ///< number of uploads of constants, simplified indices and levels
  /// Numbers of meshes, materials, textures and images that were seen.
  using Sizes = std::array<std::size_t, 4>;
  [[nodiscard]] static Sizes sizes_of(const SceneAssets& assets);

  void release();
  [[nodiscard]] Status upload_everything(const SceneAssets& assets, JobExecutor& executor);
  [[nodiscard]] Status upload_meshes(const SceneAssets& assets, JobExecutor& executor, Uploader& uploader);
  [[nodiscard]] Status upload_images(const SceneAssets& assets, Uploader& uploader);

  /// A variant of a solid primitive, if there is one.
  [[nodiscard]] SurfaceVariant drawn_variant() const;

  [[nodiscard]] bool holds_mesh(std::uint32_t mesh) const { return !use_ || use_->has_mesh(mesh); }
  [[nodiscard]] bool holds_image(const ImageKey& key) const { return !use_ || use_->has_image(key); }

  void find_changes(const SceneAssets& assets);
  void find_changed_meshes(const SceneAssets& assets);
  void find_changed_images(const SceneAssets& assets);
  void drop_images_without_use(const SceneAssets& assets);
  /// Moves the primitives together if much of their buffers is free.
  [[nodiscard]] Status compact();
  void find_changed_materials(const SceneAssets& assets);
  [[nodiscard]] bool is_new(const SceneAssets& assets, AssetKind kind, std::uint32_t index) const;
  /// Has an asset packed; if that must wait, notes that the next sync() tries again.
  void request(Progress& progress, PackRequest request, const SceneAssets& assets);
  [[nodiscard]] Progress& progress_of(const PackedAsset& asset);
  void show_mesh(std::uint32_t mesh, std::vector<PackedPrimitive>&& primitives);
  void remove_mesh(std::uint32_t mesh);
  [[nodiscard]] Status begin_upload(const SceneAssets& assets, PackedAsset&& asset);
  void finish_upload(const SceneAssets& assets, Staged&& staged);
  /// Notes that a requested asset does not arrive.
  void forget(const SceneAssets& assets, const PackedAsset& asset);
  /// Ends the uploads of assets that are gone, before a frame chooses its copies: a frame must not copy to an image
  /// that was destroyed.
  void cancel_gone_uploads(const SceneAssets& assets);
  [[nodiscard]] Status stage_changes(const SceneAssets& assets);
  void record(gpu::CommandList& commands);
  /// Whether the asset was destroyed after the state that was packed, or no texture shows the image.
  [[nodiscard]] static bool is_gone(const SceneAssets& assets, const PackedAsset& asset);

  gpu::Device& device_;
  AssetUploadOptions options_;
  MeshStreams streams_;
  GpuMaterials materials_;
  AssetUploads uploads_;
  std::optional<AssetUse> use_;  ///< none: everything is in use
  std::uint64_t version_ = 0;    ///< of SceneAssets; 0: nothing was uploaded
  std::uint64_t revision_ = 0;
  Sizes sizes_{};
  std::vector<std::vector<GpuPrimitive>> meshes_;
  std::vector<Progress> mesh_progress_;
  std::map<ImageKey, Progress> image_progress_;
  std::map<std::array<std::uint32_t, 3>, Split> split_;  ///< by instance (index, generation) and primitive
  std::vector<std::uint32_t> changed_materials_;
  std::vector<PackRequest> requests_;  ///< of this frame, if they are not packed in the background
  std::vector<PackedAsset> packed_;
  std::map<std::uint64_t, Staged> staged_;
  std::uint64_t staged_count_ = 0;
  std::uint64_t contents_ = 0;  ///< GpuPrimitive::content so far
  std::size_t smooth_primitives_ = 0;
  std::size_t left_ = 0;                        ///< changed assets that are not requested yet
  bool simplify_ = false;                       ///< simplify_casters was called
  bool simplification_left_ = false;            ///< for primitives that it has not seen
  std::array<bool, kLevelUses> levels_left_{};  ///< make_levels has not seen all primitives
  bool waiting_ = false;                        ///< the next sync() looks for changes again
  bool copies_ = false;                         ///< the current frame has copies
  bool removed_ = false;                        ///< meshes were removed since the last compact()
  AssetPacker packer_;
};

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/scene/gpu_scene.h"

#include <algorithm>
#include <string>
#include <utility>

#include "engine/core/assert.h"
#include "engine/render/packing/make_levels.h"
#include "engine/render/packing/mip_chain.h"
#include "engine/render/packing/simplified_casters.h"
#include "engine/scene/assets/check.h"
#include "shaders/render/draw_shared.h"

namespace gloam {

SurfaceVariant surface_variant(const GpuMaterial& material, const GpuPrimitive& primitive, bool flipped) {
  const gpu::CullMode one_sided = flipped ? gpu::CullMode::front : gpu::CullMode::back;
  std::uint32_t features = material.features;
  if (primitive.colored) features |= GLOAM_SURFACE_VERTEX_COLOR;
  if (primitive.flat_shaded) features |= GLOAM_SURFACE_FLAT;
  if (material.double_sided && flipped) features |= GLOAM_SURFACE_FLIPPED;
  return {features, material.double_sided ? gpu::CullMode::none : one_sided};
}

GpuScene::Sizes GpuScene::sizes_of(const SceneAssets& assets) {
  return {assets.meshes.size(), assets.materials.size(), assets.textures.size(), assets.images.size()};
}

void GpuScene::release() {
  packer_.clear();
  uploads_.clear();
  for (auto& [number, staged] : staged_)
    if (staged.image) device_.destroy(staged.image);
  staged_.clear();
  changed_materials_.clear();
  requests_.clear();
  packed_.clear();
  streams_.release();
  materials_.release();
  meshes_.clear();
  mesh_progress_.clear();
  image_progress_.clear();
  split_.clear();
  version_ = 0;
  smooth_primitives_ = left_ = 0;
  simplification_left_ = false;
  levels_left_ = {};
  waiting_ = copies_ = removed_ = false;
}

Status GpuScene::sync(const SceneAssets& assets, JobExecutor& executor, std::optional<MeshesInUse> in_use) {
  if (!in_use) {
    use_.reset();
  } else {
    if (!use_) use_.emplace();
    waiting_ = use_->update(assets, std::move(*in_use)) || waiting_;
  }
  const Sizes sizes = sizes_of(assets);
  bool shorter = false;
  for (std::size_t i = 0; i < sizes.size(); ++i) shorter = shorter || sizes[i] < sizes_[i];
  if (version_ != assets.version || shorter) return upload_everything(assets, executor);
  if (revision_ == assets.revision() && sizes_ == sizes && !waiting_) return {};
  find_changes(assets);
  revision_ = assets.revision();
  sizes_ = sizes;
  if (requests_.empty()) return {};
  const std::vector<PackRequest> requests = std::exchange(requests_, {});
  const std::size_t first = packed_.size();
  packed_.resize(first + requests.size());
  executor.parallel_for(requests.size(), 1, [&](JobRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i) packed_[first + i] = pack_asset(requests[i], assets);
  });
  return {};
}

Status GpuScene::upload_everything(const SceneAssets& assets, JobExecutor& executor) {
  const std::string fault = asset_fault(assets);
  GLOAM_ASSERT(fault.empty(), fault);
  release();
  Uploader uploader(device_);
  GLOAM_TRY(upload_meshes(assets, executor, uploader));
  GLOAM_TRY(upload_images(assets, uploader));
  GLOAM_TRY(materials_.upload(assets, uploader));
  GLOAM_TRY(uploader.flush(executor));
  materials_.use_variant(drawn_variant());
  GLOAM_TRY(materials_.make_sets(assets));
  version_ = assets.version;
  revision_ = assets.revision();
  sizes_ = sizes_of(assets);
  return {};
}

Status GpuScene::upload_meshes(const SceneAssets& assets, JobExecutor& executor, Uploader& uploader) {
  std::vector<const Primitive*> sources;
  for (std::uint32_t m = 0; m < assets.meshes.size(); ++m)
    for (const Primitive& primitive : assets.meshes[m].primitives)
      if (holds_mesh(m)) sources.push_back(&primitive);
  std::vector<PackedPrimitive> packed(sources.size());
  executor.parallel_for(sources.size(), 1, [&](JobRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i) packed[i] = pack_primitive(*sources[i], false);
  });
  for (PackedPrimitive& primitive : packed) streams_.place(primitive, false);
  GLOAM_TRY(streams_.fit());
  for (std::uint32_t stream = 0; stream < MeshStreams::kStreams; ++stream) {
    std::vector<std::byte> bytes(streams_.bytes(static_cast<MeshStreams::Stream>(stream)));
    if (bytes.empty()) continue;
    for (const PackedPrimitive& primitive : packed)
      for (const AssetUploads::BufferPart& part : streams_.parts(primitive, stream))
        std::ranges::copy(part.bytes, bytes.begin() + static_cast<std::ptrdiff_t>(part.offset));
    uploader.buffer(streams_.buffer(static_cast<MeshStreams::Stream>(stream)), std::move(bytes), MeshStreams::kAccess,
                    MeshStreams::kAlso);
  }
  meshes_.resize(assets.meshes.size());
  mesh_progress_.resize(assets.meshes.size());
  std::size_t next = 0;
  for (std::uint32_t m = 0; m < meshes_.size(); ++m) {
    if (!holds_mesh(m)) continue;
    std::vector<PackedPrimitive> primitives;
    for (std::size_t p = 0; p < assets.meshes[m].primitives.size(); ++p)
      primitives.push_back(std::move(packed[next++]));
    show_mesh(m, std::move(primitives));
    mesh_progress_[m].requested = mesh_progress_[m].shown = assets.revision(AssetKind::mesh, m);
  }
  return {};
}

SurfaceVariant GpuScene::drawn_variant() const {
  SurfaceVariant drawn;
  for (const std::vector<GpuPrimitive>& primitives : meshes_)
    for (const GpuPrimitive& primitive : primitives)
      if (material(primitive.material).alpha_mode != AlphaMode::blend)
        drawn = surface_variant(material(primitive.material), primitive, false);
  return drawn;
}

Status GpuScene::upload_images(const SceneAssets& assets, Uploader& uploader) {
  for (const Texture& texture : assets.textures) {
    const ImageKey key = key_of(texture);
    if (texture.image == kNone || materials_.images().contains(key) || !holds_image(key)) continue;
    const Image& image = assets.images[texture.image];
    const auto made = device_.create_image(texture_image_desc(image.name, image.width, image.height, texture.srgb));
    if (!made.ok()) return made.error();
    materials_.put_image(key, *made);
    uploader.image(
        *made,
        [&image, srgb = texture.srgb](std::span<std::byte> chain) {
          build_mip_chain(image.rgba, image.width, image.height, srgb, chain);
        },
        gpu::Access::fragment_read);
    Progress& progress = image_progress_[key];
    progress.requested = progress.shown = assets.revision(AssetKind::image, texture.image);
  }
  return {};
}

void GpuScene::show_mesh(std::uint32_t mesh, std::vector<PackedPrimitive>&& primitives) {
  remove_mesh(mesh);
  for (PackedPrimitive& packed : primitives) {
    packed.primitive.content = ++contents_;
    smooth_primitives_ += packed.primitive.smooth_shaded ? 1 : 0;
    simplification_left_ = simplification_left_ || !packed.primitive.simplification_tried;
    levels_left_.fill(true);
    meshes_[mesh].push_back(std::move(packed.primitive));
  }
}

void GpuScene::remove_mesh(std::uint32_t mesh) {
  removed_ = removed_ || !meshes_[mesh].empty();
  for (const GpuPrimitive& primitive : meshes_[mesh]) {
    smooth_primitives_ -= primitive.smooth_shaded ? 1 : 0;
    streams_.remove(primitive);
  }
  meshes_[mesh].clear();
}

Status GpuScene::simplify_casters(const SceneAssets& assets, JobExecutor& executor) {
  GLOAM_ASSERT(version_ == assets.version, "casters of the assets that sync has found are simplified");
  simplify_ = true;
  if (!std::exchange(simplification_left_, false)) return {};
  std::vector<std::pair<const Primitive*, GpuPrimitive*>> primitives;
  for (std::uint32_t m = 0; m < meshes_.size(); ++m) {
    const bool current = mesh_progress_[m].shown == assets.revision(AssetKind::mesh, m);
    for (std::size_t p = 0; current && p < meshes_[m].size(); ++p)
      if (!std::exchange(meshes_[m][p].simplification_tried, true))
        primitives.emplace_back(&assets.meshes[m].primitives[p], &meshes_[m][p]);
  }
  std::vector<std::vector<std::uint32_t>> made(primitives.size());
  executor.parallel_for(primitives.size(), 1, [&](JobRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      const auto& [source, primitive] = primitives[i];
      const bool rigid = !primitive->skinned && primitive->morph_targets == 0;
      if (rigid && material(primitive->material).alpha_mode == AlphaMode::opaque)
        made[i] = simplified_in_fetch_order(*source);
    }
  });
  AssetUploads::Job job{.number = kNoAsset, .parts = {}, .image = {}, .texels = {}, .urgent = true};
  for (std::size_t i = 0; i < made.size(); ++i) {
    streams_.place_simplified(*primitives[i].second, made[i].size(), false);
    job.parts.push_back(MeshStreams::simplified_part(*primitives[i].second, made[i]));
  }
  uploads_.add(std::move(job));
  return {};
}

Status GpuScene::make_levels(const SceneAssets& assets, JobExecutor& executor, LevelUse use) {
  GLOAM_ASSERT(version_ == assets.version, "the assets that sync has found get levels");
  const auto number = static_cast<std::size_t>(use);
  if (!std::exchange(levels_left_[number], false)) return {};
  std::vector<std::pair<const Primitive*, GpuPrimitive*>> primitives;
  for (std::uint32_t m = 0; m < meshes_.size(); ++m) {
    const bool current = mesh_progress_[m].shown == assets.revision(AssetKind::mesh, m);
    for (std::size_t p = 0; current && p < meshes_[m].size(); ++p) {
      GpuPrimitive& primitive = meshes_[m][p];
      if (std::exchange(primitive.detail[number].tried, true)) continue;
      if (material(primitive.material).alpha_mode == AlphaMode::opaque)
        primitives.emplace_back(&assets.meshes[m].primitives[p], &primitive);
    }
  }
  std::vector<MadeLevels> made(primitives.size());
  executor.parallel_for(primitives.size(), 1, [&](JobRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i) made[i] = gloam::make_levels(*primitives[i].first, use);
  });
  AssetUploads::Job job{.number = kNoAsset, .parts = {}, .image = {}, .texels = {}, .urgent = true};
  for (std::size_t i = 0; i < made.size(); ++i) {
    if (made[i].indices.empty()) continue;
    DetailLevels& levels = primitives[i].second->detail[number];
    levels = std::move(made[i].levels);
    levels.tried = true;
    streams_.place_levels(levels, false);
    job.parts.push_back(MeshStreams::levels_part(levels, made[i].indices));
  }
  if (!job.parts.empty()) uploads_.add(std::move(job));
  return {};
}

std::size_t GpuScene::pending() const {
  std::size_t count = left_;
  for (const Progress& progress : mesh_progress_) count += progress.in_flight ? 1 : 0;
  for (const auto& [key, progress] : image_progress_) count += progress.in_flight ? 1 : 0;
  return count;
}

}  // namespace gloam

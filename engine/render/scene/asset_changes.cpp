// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
// Changes of single assets: what is packed, copied and shown in which frame.
#include <algorithm>
#include <limits>
#include <string>
#include <utility>

#include "engine/core/assert.h"
#include "engine/render/scene/gpu_scene.h"
#include "engine/scene/assets/check.h"

namespace gloam {
namespace {

/// Most bytes of changed assets that are held besides SceneAssets: copied for packing, packed, or partly uploaded. One
/// asset may exceed it.
constexpr std::uint64_t kMostHeldBytes = std::uint64_t{64} << 20;

/// Index of the materials' constants among the targets of AssetUploads, after the streams.
constexpr std::uint32_t kConstants = MeshStreams::kStreams;

bool shows(const SceneAssets& assets, const ImageKey& key) {
  return std::ranges::any_of(assets.textures, [&](const Texture& texture) { return key_of(texture) == key; });
}

}  // namespace

bool GpuScene::is_new(const SceneAssets& assets, AssetKind kind, std::uint32_t index) const {
  return assets.revision(kind, index) > revision_ || index >= sizes_[static_cast<std::size_t>(kind)];
}

void GpuScene::find_changes(const SceneAssets& assets) {
  std::string fault = asset_fault_since(assets, revision_);
  for (const AssetKind kind : {AssetKind::mesh, AssetKind::material, AssetKind::texture, AssetKind::image})
    for (std::size_t i = sizes_[static_cast<std::size_t>(kind)]; i < assets.count(kind) && fault.empty(); ++i)
      fault = asset_fault(assets, kind, static_cast<std::uint32_t>(i));
  GLOAM_ASSERT(fault.empty(), fault);
  waiting_ = false;
  left_ = 0;
  cancel_gone_uploads(assets);
  find_changed_materials(assets);
  find_changed_images(assets);
  find_changed_meshes(assets);
}

void GpuScene::request(Progress& progress, PackRequest request, const SceneAssets& assets) {
  if (progress.in_flight || (options_.background && packer_.bytes() + uploads_.bytes() > kMostHeldBytes)) {
    waiting_ = true;
    ++left_;
    return;
  }
  progress.requested = request.revision;
  progress.in_flight = true;
  if (options_.background)
    packer_.request(std::move(request), assets);
  else
    requests_.push_back(std::move(request));
}

void GpuScene::find_changed_meshes(const SceneAssets& assets) {
  meshes_.resize(assets.meshes.size());
  mesh_progress_.resize(assets.meshes.size());
  for (std::uint32_t m = 0; m < meshes_.size(); ++m) {
    Progress& progress = mesh_progress_[m];
    const std::uint64_t revision = assets.revision(AssetKind::mesh, m);
    if (!holds_mesh(m)) {
      if (progress.in_flight) continue;  // when it has come, it is looked at again
      remove_mesh(m);
      progress = {};
      continue;
    }
    if (progress.requested == revision) continue;
    if (assets.is_destroyed(AssetKind::mesh, m)) {
      remove_mesh(m);
      progress.requested = progress.shown = revision;
      continue;
    }
    // The place of a destroyed mesh was taken by another one: nothing is drawn until that one is complete.
    if (progress.shown != kNever && assets.destroyed_at(AssetKind::mesh, m) > progress.shown) {
      remove_mesh(m);
      progress.shown = kNever;
    }
    PackRequest wanted{.index = m, .revision = revision};
    for (const Primitive& primitive : assets.meshes[m].primitives) {
      const bool opaque =
          primitive.material == kNone || assets.materials[primitive.material].alpha_mode == AlphaMode::opaque;
      wanted.simplify.push_back(simplify_ && opaque);
    }
    request(progress, std::move(wanted), assets);
  }
}

void GpuScene::find_changed_images(const SceneAssets& assets) {
  std::vector<bool> touched(assets.textures.size(), false);
  bool any = false;
  for (std::uint32_t t = 0; t < touched.size(); ++t) {
    touched[t] = is_new(assets, AssetKind::texture, t);
    any = any || touched[t];
    const ImageKey key = key_of(assets.textures[t]);
    if (key.first == kNone || !holds_image(key)) continue;
    Progress& progress = image_progress_[key];
    const std::uint64_t revision = assets.revision(AssetKind::image, key.first);
    if (progress.shown != kNever && assets.destroyed_at(AssetKind::image, key.first) > progress.shown) {
      materials_.show_image(assets, key, {});  // white until the image in the place of the destroyed one is complete
      progress.shown = kNever;
    }
    if (progress.requested != revision)
      request(progress, {.index = key.first, .revision = revision, .is_image = true, .srgb = key.second}, assets);
  }
  if (any) materials_.touch_textures(assets, touched);
  drop_images_without_use(assets);
}

void GpuScene::drop_images_without_use(const SceneAssets& assets) {
  for (auto it = image_progress_.begin(); it != image_progress_.end();) {
    if (it->second.in_flight || (holds_image(it->first) && shows(assets, it->first))) {
      ++it;
      continue;
    }
    materials_.show_image(assets, it->first, {});
    it = image_progress_.erase(it);
  }
}

void GpuScene::find_changed_materials(const SceneAssets& assets) {
  std::vector<std::uint32_t> changed;
  for (std::uint32_t m = 0; m < assets.materials.size(); ++m)
    if (is_new(assets, AssetKind::material, m)) changed.push_back(m);
  changed_materials_.insert(changed_materials_.end(), changed.begin(), changed.end());
}

GpuScene::Progress& GpuScene::progress_of(const PackedAsset& asset) {
  return asset.is_image ? image_progress_[{asset.index, asset.srgb}] : mesh_progress_[asset.index];
}

bool GpuScene::is_gone(const SceneAssets& assets, const PackedAsset& asset) {
  if (asset.is_image && !shows(assets, {asset.index, asset.srgb})) return true;
  return assets.destroyed_at(asset.is_image ? AssetKind::image : AssetKind::mesh, asset.index) > asset.revision;
}

Status GpuScene::begin_upload(const SceneAssets& assets, PackedAsset&& asset) {
  if (!asset.fault.empty())
    return Error{ErrorKind::failed,
                 std::string(asset.is_image ? "image " : "mesh ") + std::to_string(asset.index) + ": " + asset.fault};
  if (is_gone(assets, asset)) {
    forget(assets, asset);
    return {};
  }
  Staged staged;
  AssetUploads::Job job;
  job.number = ++staged_count_;
  if (asset.is_image) {
    const auto image = device_.create_image(texture_image_desc(asset.name, asset.width, asset.height, asset.srgb));
    if (!image.ok()) return image.error();
    job.image = staged.image = *image;
    job.texels = std::exchange(asset.texels, {});
  }
  for (PackedPrimitive& packed : asset.primitives) {
    streams_.place(packed, true);
    for (std::uint32_t stream = 0; stream < MeshStreams::kStreams; ++stream)
      for (AssetUploads::BufferPart& part : streams_.parts(packed, stream)) job.parts.push_back(std::move(part));
    packed = PackedPrimitive{.primitive = std::move(packed.primitive)};
  }
  staged.asset = std::move(asset);
  uploads_.add(std::move(job));
  staged_.emplace(staged_count_, std::move(staged));
  return {};
}

void GpuScene::forget(const SceneAssets& assets, const PackedAsset& asset) {
  Progress& progress = progress_of(asset);
  progress.in_flight = false;
  progress.requested = kNever;  // it did not arrive: its next use requests it again
  waiting_ = true;
  const ImageKey key{asset.index, asset.srgb};
  if (!asset.is_image || shows(assets, key)) return;
  materials_.show_image(assets, key, {});
  image_progress_.erase(key);
}

void GpuScene::cancel_gone_uploads(const SceneAssets& assets) {
  for (auto it = staged_.begin(); it != staged_.end();) {
    const Staged& staged = it->second;
    if (!is_gone(assets, staged.asset)) {
      ++it;
      continue;
    }
    uploads_.cancel(it->first);
    if (staged.image) device_.destroy(staged.image);
    for (const PackedPrimitive& packed : staged.asset.primitives) streams_.remove(packed.primitive);
    forget(assets, staged.asset);
    it = staged_.erase(it);
  }
}

void GpuScene::finish_upload(const SceneAssets& assets, Staged&& staged) {
  const PackedAsset& asset = staged.asset;
  Progress& progress = progress_of(asset);
  progress.in_flight = false;
  progress.shown = asset.revision;
  waiting_ = true;  // it may have changed since
  if (asset.is_image)
    materials_.show_image(assets, {asset.index, asset.srgb}, staged.image);
  else
    show_mesh(asset.index, std::move(staged.asset.primitives));
}

Status GpuScene::stage(const SceneAssets& assets) {
  const Status staged = stage_changes(assets);
  if (!staged.ok()) version_ = 0;  // the next sync() uploads everything
  return staged;
}

Status GpuScene::stage_changes(const SceneAssets& assets) {
  if (!changed_materials_.empty()) {
    std::ranges::sort(changed_materials_);
    changed_materials_.erase(std::unique(changed_materials_.begin(), changed_materials_.end()),
                             changed_materials_.end());
    auto parts = materials_.change(assets, std::exchange(changed_materials_, {}), kConstants);
    if (!parts.ok()) return parts.error();
    uploads_.add({.number = kNoAsset, .parts = std::move(*parts), .image = {}, .texels = {}, .urgent = true});
  }
  for (PackedAsset& asset : options_.background ? packer_.take() : std::exchange(packed_, {}))
    GLOAM_TRY(begin_upload(assets, std::move(asset)));
  GLOAM_TRY(streams_.fit());
  GLOAM_TRY(compact());
  auto finished = uploads_.stage(options_.background ? options_.budget : std::numeric_limits<std::uint64_t>::max());
  if (!finished.ok()) return finished.error();
  for (const std::uint64_t number : *finished) {
    if (number == kNoAsset) continue;
    const auto staged = staged_.find(number);
    finish_upload(assets, std::move(staged->second));
    staged_.erase(staged);
  }
  copies_ = uploads_.has_copies() || streams_.has_growth();
  return materials_.make_sets(assets);
}

Status GpuScene::compact() {
  // What an upload under way is copied to keeps its place.
  if (!removed_ || !staged_.empty() || uploads_.bytes() > 0 || streams_.has_growth()) return {};
  removed_ = false;
  if (!streams_.is_sparse()) return {};
  std::vector<GpuPrimitive*> primitives;
  for (std::vector<GpuPrimitive>& mesh : meshes_)
    for (GpuPrimitive& primitive : mesh) primitives.push_back(&primitive);
  for (auto& [key, split] : split_)
    if (split.split) primitives.push_back(&split.primitive);
  return streams_.compact(primitives);
}

void GpuScene::add_pass(FrameGraph& graph) {
  if (!copies_) return;
  PassBuilder pass = graph.add_pass("upload_assets", "engine");
  pass.keep();  // writes buffers and images that the graph does not track: never cull
  pass.execute([this](PassContext& context) { record(context.commands()); });
}

void GpuScene::record(gpu::CommandList& commands) {
  streams_.record_growth(commands);
  if (!uploads_.has_copies()) return;
  std::vector<AssetUploads::Target> targets;
  for (std::uint32_t stream = 0; stream < MeshStreams::kStreams; ++stream)
    targets.push_back(
        {streams_.buffer(static_cast<MeshStreams::Stream>(stream)), MeshStreams::kAccess, MeshStreams::kAlso});
  targets.push_back({materials_.constants(), gpu::Access::uniform_read, 0});
  uploads_.record(commands, targets);
}

void GpuScene::give_up_frame() {
  if (std::exchange(copies_, false)) version_ = 0;
}

}  // namespace gloam

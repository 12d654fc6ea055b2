// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/uploads/asset_packer.h"

#include <exception>
#include <system_error>
#include <utility>

#include "engine/render/packing/mip_chain.h"

namespace gloam {
namespace {

template <class T>
std::uint64_t bytes_in(const std::vector<T>& values) {
  return values.size() * sizeof(T);
}

std::uint64_t bytes_in(const Primitive& p) {
  std::uint64_t bytes = bytes_in(p.positions) + bytes_in(p.normals) + bytes_in(p.tangents) + bytes_in(p.uv0);
  bytes += bytes_in(p.uv1) + bytes_in(p.colors) + bytes_in(p.joints) + bytes_in(p.weights) + bytes_in(p.indices);
  for (const Primitive::MorphTarget& target : p.morph_targets)
    bytes += bytes_in(target.positions) + bytes_in(target.normals);
  return bytes;
}

std::uint64_t bytes_in(const PackedAsset& packed) {
  std::uint64_t bytes = packed.texels.size();
  for (const PackedPrimitive& p : packed.primitives)
    bytes += bytes_in(p.positions) + bytes_in(p.frames) + bytes_in(p.surfaces) + bytes_in(p.indices) +
             bytes_in(p.simplified) + bytes_in(p.influences) + bytes_in(p.morph_offsets);
  return bytes;
}

PackedAsset pack(const PackRequest& request, const Mesh& mesh) {
  PackedAsset packed{.index = request.index, .revision = request.revision};
  packed.name = mesh.name;
  packed.primitives = pack_mesh(mesh, request.simplify);
  return packed;
}

PackedAsset pack(const PackRequest& request, const Image& image) {
  PackedAsset packed{.index = request.index, .revision = request.revision, .is_image = true};
  packed.name = image.name;
  packed.srgb = request.srgb;
  packed.width = image.width;
  packed.height = image.height;
  packed.texels.resize(mip_chain_bytes(image.width, image.height));
  build_mip_chain(image.rgba, image.width, image.height, request.srgb, packed.texels);
  return packed;
}

}  // namespace

PackedAsset pack_asset(const PackRequest& request, const SceneAssets& assets) {
  return request.is_image ? pack(request, assets.images[request.index]) : pack(request, assets.meshes[request.index]);
}

std::uint64_t AssetPacker::bytes_of(const Copied& copied) {
  std::uint64_t bytes = copied.image.rgba.size();
  for (const Primitive& primitive : copied.mesh.primitives) bytes += bytes_in(primitive);
  return bytes;
}

void AssetPacker::request(PackRequest request, const SceneAssets& assets) {
  Copied copied{std::move(request), {}, {}};
  if (copied.request.is_image)
    copied.image = assets.images[copied.request.index];
  else
    copied.mesh = assets.meshes[copied.request.index];
  std::unique_lock lock(mutex_);
  bytes_ += bytes_of(copied);
  requests_.push_back(std::move(copied));
  try {
    if (!thread_.joinable()) thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
  } catch (const std::system_error&) {  // the system gives no thread
    while (!requests_.empty()) pack_first(lock);
  }
  wake_.notify_one();
}

std::vector<PackedAsset> AssetPacker::take() {
  const std::lock_guard lock(mutex_);
  for (const PackedAsset& packed : results_) bytes_ -= bytes_in(packed);
  return std::exchange(results_, {});
}

void AssetPacker::clear() {
  const std::lock_guard lock(mutex_);
  ++generation_;
  requests_.clear();
  results_.clear();
  bytes_ = 0;
}

std::uint64_t AssetPacker::bytes() const {
  const std::lock_guard lock(mutex_);
  return bytes_;
}

void AssetPacker::pack_first(std::unique_lock<std::mutex>& lock) {
  const Copied copied = std::move(requests_.front());
  const PackRequest& request = copied.request;
  requests_.pop_front();
  const std::uint64_t generation = generation_;
  lock.unlock();
  PackedAsset packed;
  try {
    packed = request.is_image ? pack(request, copied.image) : pack(request, copied.mesh);
  } catch (const std::exception& failure) {
    packed = {.index = request.index, .revision = request.revision, .is_image = request.is_image};
    packed.fault = failure.what();
  }
  lock.lock();
  if (generation != generation_) return;
  bytes_ += bytes_in(packed);
  bytes_ -= bytes_of(copied);
  results_.push_back(std::move(packed));
}

void AssetPacker::run(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  while (wake_.wait(lock, stop, [&] { return !requests_.empty(); }) && !stop.stop_requested()) pack_first(lock);
}

}  // namespace gloam

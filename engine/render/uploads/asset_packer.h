// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <mutex>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "engine/render/packing/packed_primitive.h"
#include "engine/scene/assets.h"

namespace gloam {

/// A mesh or an image that is to be packed.
struct PackRequest {
  std::uint32_t index = 0;     ///< in SceneAssets
  std::uint64_t revision = 0;  ///< SceneAssets::revision of its state
  bool is_image = false;
  std::vector<bool> simplify = {};  ///< of each primitive of a mesh
  bool srgb = false;                ///< of an image
};

/// A mesh or an image as the GPU reads it.
struct PackedAsset {
  std::uint32_t index = 0;
  std::uint64_t revision = 0;
  bool is_image = false;
  std::vector<PackedPrimitive> primitives;
  bool srgb = false;
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<std::byte> texels;  ///< of all mips
  std::string name;
  std::string fault;  ///< why packing failed; empty: it did not
};

[[nodiscard]] PackedAsset pack_asset(const PackRequest& request, const SceneAssets& assets);

/// Packs assets on a thread, in the order of the requests; on the calling thread if the system gives no other one.
class AssetPacker {
 public:
  AssetPacker() = default;
  AssetPacker(const AssetPacker&) = delete;
  AssetPacker& operator=(const AssetPacker&) = delete;

  /// Copies the asset, which may change afterwards.
  void request(PackRequest request, const SceneAssets& assets);
  /// The assets that were packed since the last call, in the order of their requests.
  [[nodiscard]] std::vector<PackedAsset> take();
  /// Drops all requests and results.
  void clear();
  /// Bytes of the copies and results that it holds.
  [[nodiscard]] std::uint64_t bytes() const;

 private:
  struct Copied {
    PackRequest request;
    Mesh mesh;
    Image image;
  };
  void run(const std::stop_token& stop);
  /// Packs the first request, without the lock meanwhile.
  void pack_first(std::unique_lock<std::mutex>& lock);
  [[nodiscard]] static std::uint64_t bytes_of(const Copied& copied);

  mutable std::mutex mutex_;
  std::condition_variable_any wake_;
  std::deque<Copied> requests_;
  std::vector<PackedAsset> results_;
  std::uint64_t bytes_ = 0;
  std::uint64_t generation_ = 0;  ///< counts calls of clear(); the result of an older one is dropped
  std::jthread thread_;           ///< started by the first request; destroyed before the members above
};

}  // namespace gloam

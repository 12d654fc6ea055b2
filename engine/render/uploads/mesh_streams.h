// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/core/range_allocator.h"
#include "engine/core/result.h"
#include "engine/gpu/device.h"
#include "engine/render/packing/packed_primitive.h"
#include "engine/render/uploads/asset_uploads.h"

namespace gloam {

/// The buffers of all primitives of a scene, one a stream. Primitives have ranges in them.
class MeshStreams {
 public:
  enum Stream : std::uint32_t { positions, frames, surfaces, indices, influences, morph_offsets };
  static constexpr std::uint32_t kStreams = 6;
  /// How draws and passes read the buffers.
  static constexpr gpu::Access kAccess = gpu::Access::vertex_input;
  static constexpr gpu::AccessMask kAlso =
      gpu::mask_of(gpu::Access::compute_read) | gpu::mask_of(gpu::Access::vertex_read);

  explicit MeshStreams(gpu::Device& device) : device_(device) {}
  ~MeshStreams() { release(); }
  MeshStreams(const MeshStreams&) = delete;
  MeshStreams& operator=(const MeshStreams&) = delete;

  /// Finds ranges for a primitive and writes them into packed.primitive. Rows grow by what is missing, or by half if
  /// `spare` (for primitives that come one by one).
  void place(PackedPrimitive& packed, bool spare);
  /// The same for the simplified indices alone.
  void place_simplified(GpuPrimitive& primitive, std::size_t count, bool spare);
  /// The same for the indices of its levels alone.
  void place_levels(DetailLevels& levels, bool spare);
  /// Gives the ranges back. GPU frames may still read them: later copies wait for those.
  void remove(const GpuPrimitive& primitive);
  /// Makes the buffers as large as the ranges need; call it after place(). Larger buffers take the contents of those
  /// that they replace over in record_growth().
  [[nodiscard]] Status fit();
  /// Whether more bytes of the buffers are free than in use, and more than 1 MiB.
  [[nodiscard]] bool is_sparse() const;
  /// Moves these primitives, which are all that have ranges, together in new buffers that are just large enough. Not
  /// while has_growth(). The contents follow in record_growth(), before copies of this frame.
  [[nodiscard]] Status compact(std::span<GpuPrimitive* const> primitives);
  [[nodiscard]] bool has_growth() const;
  void record_growth(gpu::CommandList& commands);
  /// The bytes of a placed primitive in one of the streams.
  [[nodiscard]] static std::vector<AssetUploads::BufferPart> parts(const PackedPrimitive& packed, std::uint32_t stream);
  [[nodiscard]] static AssetUploads::BufferPart simplified_part(const GpuPrimitive& primitive,
                                                                const std::vector<std::uint32_t>& simplified);
  [[nodiscard]] static AssetUploads::BufferPart levels_part(const DetailLevels& levels,
                                                            const std::vector<std::uint32_t>& made);
  /// Bytes of the whole stream as placed.
  [[nodiscard]] std::uint64_t bytes(Stream stream) const;
  [[nodiscard]] gpu::BufferHandle buffer(Stream stream) const { return buffers_[stream]; }
  void release();

 private:
  /// Elements of a stream that move from the replaced buffer to the new one.
  struct Move {
    std::uint32_t from = 0;
    std::uint32_t to = 0;
    std::size_t count = 0;
  };
  [[nodiscard]] const RangeAllocator& ranges_of(Stream stream) const;
  [[nodiscard]] std::uint32_t allocate(RangeAllocator& ranges, std::size_t count, bool spare);
  static void free(RangeAllocator& ranges, std::uint32_t first, std::size_t count);

  gpu::Device& device_;
  std::array<gpu::BufferHandle, kStreams> buffers_{};
  std::array<gpu::BufferHandle, kStreams> replaced_{};  ///< whose contents the new buffers do not have yet
  std::array<std::vector<Move>, kStreams> moves_;       ///< none: all of a replaced buffer goes to the same place
  RangeAllocator vertices_, index_ranges_, influence_ranges_, morph_ranges_;  ///< in units of kUnit elements
};

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>

#include "engine/frame/transfers/upload.h"
#include "engine/gpu/device.h"

namespace gloam {

/// Staging memory of a module whose uploads are rare: it exists from the first use until release().
class Staging {
 public:
  /// module: names the memory; a literal.
  explicit Staging(const char* module) : module_(module) {}

  /// The ring of the device's current frame.
  [[nodiscard]] UploadRing& ring(gpu::Device& device) {
    if (ring_ == nullptr)
      ring_ = std::make_unique<UploadRing>(device, module_, gpu::BufferUsage::transfer_source, kLeastBytes);
    if (frame_ != device.frame_number()) ring_->begin_frame();
    frame_ = device.frame_number();
    return *ring_;
  }
  void release() { ring_.reset(); }

 private:
  static constexpr std::uint64_t kLeastBytes = 1 << 16;
  const char* module_;
  std::unique_ptr<UploadRing> ring_;
  std::uint64_t frame_ = ~0ull;
};

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/gpu/types.h"

namespace gloam {

class PassContext;

/// The declarations of one frame as data. FrameGraph collects them and compile_plan turns them into a plan. Slots and
/// their strings are reused from frame to frame.
namespace frame {

struct DeclaredResource {
  bool is_image = false;
  bool imported = false;
  gpu::ImageDesc image_desc;    ///< of a transient image; an import sets the name, and mips and layers if they matter
  gpu::BufferDesc buffer_desc;  ///< of a transient buffer; an import sets only the name
  gpu::ImageHandle image;       ///< of an import
  gpu::BufferHandle buffer;     ///< of an import
  gpu::Access before = gpu::Access::none;
  gpu::Access after = gpu::Access::none;
  std::uint32_t version = 0;  ///< the newest version; 0: no pass has written it

  [[nodiscard]] const std::string& name() const { return is_image ? image_desc.name : buffer_desc.name; }
};

/// All accesses of one pass to one resource, or to one range of an image's mips and layers. Ranges of one pass do not
/// overlap.
struct DeclaredUse {
  std::uint32_t resource = 0;
  gpu::AccessMask accesses = 0;     ///< reads of one layout, or one write
  std::uint32_t first_version = 0;  ///< version before the pass
  std::uint32_t last_version = 0;   ///< version after the pass
  bool reads = false;
  bool writes = false;
  gpu::ImageRange range;  ///< default: the whole resource; otherwise without counts of 0
};

struct DeclaredPass {
  std::string name;
  std::string module;
  std::uint32_t view = 0;
  std::uint32_t first_use = 0;
  std::uint32_t use_count = 0;
  bool keep = false;
  std::function<void(PassContext&)> function;
};

/// A vector that is emptied without destroying its items, so that the next frame reuses their memory.
template <class T>
class SlotVector {
 public:
  /// Appends a slot and returns it. The slot still has its old contents.
  [[nodiscard]] T& add() {
    if (size_ == items_.size()) items_.emplace_back();
    return items_[size_++];
  }
  void forget() { size_ = 0; }
  [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(size_); }
  [[nodiscard]] T& operator[](std::size_t i) { return items_[i]; }
  [[nodiscard]] const T& operator[](std::size_t i) const { return items_[i]; }
  [[nodiscard]] T& back() { return items_[size_ - 1]; }
  [[nodiscard]] std::span<T> all() { return {items_.data(), size_}; }
  [[nodiscard]] std::span<const T> all() const { return {items_.data(), size_}; }

 private:
  std::vector<T> items_;
  std::size_t size_ = 0;
};

struct Declaration {
  SlotVector<DeclaredPass> passes;
  SlotVector<DeclaredResource> resources;
  std::vector<DeclaredUse> uses;

  [[nodiscard]] std::span<const DeclaredUse> uses_of(const DeclaredPass& pass) const {
    return {uses.data() + pass.first_use, pass.use_count};
  }
};

/// Combines the accesses of one pass to one resource: reads of one layout, or a write that includes the reads. Returns
/// 0 if one pass cannot make them all.
[[nodiscard]] gpu::AccessMask combine_accesses(gpu::AccessMask have, gpu::Access more, bool is_image);

/// A hash of names, descriptions and accesses. Handles of imports are not included.
[[nodiscard]] std::uint64_t structural_hash(const Declaration& declaration);

}  // namespace frame
}  // namespace gloam

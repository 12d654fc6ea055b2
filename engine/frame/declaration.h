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

/// A frame's declarations as data: what FrameGraph collects and compile_plan turns into a plan. Slots and their strings
/// are reused from frame to frame.
namespace frame {

struct DeclaredResource {
  bool is_image = false;
  bool imported = false;
  gpu::ImageDesc image_desc;    ///< of a transient image; an import has only its name here
  gpu::BufferDesc buffer_desc;  ///< of a transient buffer; an import has only its name here
  gpu::ImageHandle image;       ///< of an import
  gpu::BufferHandle buffer;     ///< of an import
  gpu::Access before = gpu::Access::none;
  gpu::Access after = gpu::Access::none;
  std::uint32_t version = 0;  ///< the newest; 0 has been written by no pass

  [[nodiscard]] const std::string& name() const { return is_image ? image_desc.name : buffer_desc.name; }
};

/// Everything one pass does to one resource.
struct DeclaredUse {
  std::uint32_t resource = 0;
  gpu::AccessMask accesses = 0;  ///< reads of one layout, or one write
  std::uint32_t first_version = 0;
  std::uint32_t last_version = 0;
  bool reads = false;
  bool writes = false;
};

struct DeclaredPass {
  std::string name;
  std::string module;
  std::uint32_t first_use = 0;
  std::uint32_t use_count = 0;
  bool keep = false;
  std::function<void(PassContext&)> function;
};

/// A vector that forgets its items without destroying them, so that their memory serves the next frame.
template <class T>
class SlotVector {
 public:
  /// The next slot, with whatever it held before.
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

/// Both accesses of one pass on one resource as one: reads of one layout together, or a write that includes the read.
/// 0 when they cannot happen in one pass.
[[nodiscard]] gpu::AccessMask combine_accesses(gpu::AccessMask have, gpu::Access more, bool is_image);

/// Of names, descriptions and accesses; handles of imports do not count.
[[nodiscard]] std::uint64_t structural_hash(const Declaration& declaration);

}  // namespace frame
}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/maps/state.h"

#include <algorithm>
#include <iterator>
#include <set>

#include "modules/shadows/maps/images.h"

namespace gloam {
namespace {

constexpr std::uint64_t kFramesKept = 120;

}  // namespace

void ShadowStates::begin(gpu::Device& device) {
  device_ = &device;
  if (staging_ == nullptr)
    staging_ = std::make_unique<UploadRing>(device, "shadows", gpu::BufferUsage::transfer_source, 1 << 16);
  const std::uint64_t frame = device.frame_number();
  if (staging_frame_ == frame) return;
  staging_->begin_frame();
  if (!has_traced_) traced_staging_.reset();
  if (traced_staging_ != nullptr) traced_staging_->begin_frame();
  has_traced_ = false;
  if (scratch_frame_ + kFramesKept < frame) scratch_.release(device);
  staging_frame_ = frame;
  const auto is_unused = [&](const auto& entry) { return entry.second.last_frame + kFramesKept < frame; };
  std::erase_if(views_, is_unused);
  std::erase_if(turns_, is_unused);
  std::erase_if(extra_maps_, is_unused);
}

ViewMapState& ShadowStates::view(std::uint64_t world, const ViewFaces& faces, ViewId user) {
  ViewMapState& found = views_[key_of(world, faces)];
  if (found.number == 0) found.number = ++numbers_;
  found.users.insert(user.value);
  found.last_frame = device_->frame_number();
  return found;
}

const ViewMapState* ShadowStates::find(std::uint64_t world, const ViewFaces& faces) const {
  const auto found = views_.find(key_of(world, faces));
  return found == views_.end() ? nullptr : &found->second;
}

void ShadowStates::choose_images(const ViewFaces& faces, const ShadowKnobs& knobs, ViewMapState& view) const {
  view.image_bytes = map_image_bytes(knobs, view.has_backgrounds);
  std::uint64_t bytes = view.image_bytes;
  for (const auto& [key, other] : views_)
    if (other.number < view.number && !other.takes_turns) bytes += other.image_bytes;
  view.takes_turns = faces.shared == nullptr && bytes > knobs.kept_atlas_bytes;
}

std::size_t ShadowStates::views_in_turns() const {
  return static_cast<std::size_t>(
      std::count_if(views_.begin(), views_.end(), [](const auto& view) { return view.second.takes_turns; }));
}

bool ShadowStates::take_turn(std::uint64_t world, const ViewMapState& view, const ShadowKnobs& knobs,
                             std::uint32_t frame) {
  Turns& turns = turns_[{world, knobs.atlas_size, knobs.d16}];
  const std::uint64_t before = turns.frame == frame ? turns.last : turns.holder;
  turns.last = view.number;
  turns.frame = frame;
  turns.last_frame = device_->frame_number();
  return before == view.number;
}

void ShadowStates::commit_turn(std::uint64_t world, const ViewMapState& view, const ShadowKnobs& knobs) {
  turns_[{world, knobs.atlas_size, knobs.d16}].holder = view.number;
}

void ShadowStates::free_idle_memory() {
  if (device_ != nullptr) scratch_.release(*device_);
  staging_.reset();
  traced_staging_.reset();
  has_traced_ = false;
  staging_frame_ = ~0ull;
}

void ShadowStates::skip_frame(std::uint64_t world, const ViewFaces& faces) {
  const auto found = views_.find(key_of(world, faces));
  if (found == views_.end()) return;
  found->second.counts = {};
  if (found->second.users.size() <= 1) found->second.frame.drawn.clear();
}

ExtraMapState& ShadowStates::extra_maps(std::uint64_t world, ViewId view) {
  ExtraMapState& found = extra_maps_[{world, view.value}];
  found.last_frame = device_->frame_number();
  return found;
}

void ShadowStates::release_view(ViewId view) {
  std::erase_if(extra_maps_, [&](const auto& entry) { return entry.first.second == view.value; });
  for (auto at = views_.begin(); at != views_.end();) {
    std::set<std::uint32_t>& users = at->second.users;
    const bool last = users.erase(view.value) > 0 && users.empty();
    at = last ? views_.erase(at) : std::next(at);
  }
}

UploadRing& ShadowStates::traced_staging() {
  has_traced_ = true;
  if (traced_staging_ == nullptr) {
    traced_staging_ = std::make_unique<UploadRing>(*device_, "shadows", gpu::BufferUsage::transfer_source, 1);
    traced_staging_->begin_frame();
  }
  return *traced_staging_;
}

Result<const ShadowScratch*> ShadowStates::scratch(std::uint64_t texels) {
  scratch_frame_ = device_->frame_number();
  GLOAM_TRY(scratch_.reserve(*device_, texels));
  return &scratch_;
}

void ShadowStates::release() {
  if (device_ != nullptr) scratch_.release(*device_);
  views_.clear();
  turns_.clear();
  extra_maps_.clear();
  staging_.reset();
  traced_staging_.reset();
  has_traced_ = false;
  staging_frame_ = ~0ull;
}

}  // namespace gloam

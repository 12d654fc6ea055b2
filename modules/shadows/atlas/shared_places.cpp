// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/atlas/shared_places.h"

#include <algorithm>

#include "shaders/shadows/shadows_shared.h"

namespace gloam {

void SharedPlaces::join(std::uint64_t frame, std::uint32_t view) {
  if (frame != joined_frame_) joined_.clear();
  joined_frame_ = frame;
  if (std::ranges::find(joined_, view) == joined_.end()) joined_.push_back(view);
}

std::uint32_t SharedPlaces::sharers() const {
  return std::max<std::uint32_t>(1, static_cast<std::uint32_t>(joined_.size()));
}

const SharedPlaces::Placed* SharedPlaces::find(const FaceKey& key) const {
  const auto found = std::ranges::find_if(placed_, [&](const Placed& placed) { return placed.request.key == key; });
  return found == placed_.end() ? nullptr : &*found;
}

bool SharedPlaces::try_place(std::uint32_t size, std::span<const FaceRequest> fresh, bool with_last) {
  std::vector<FaceRequest> all;
  for (const Placed& placed : placed_) all.push_back(placed.request);
  all.insert(all.end(), fresh.begin(), fresh.end());
  const std::size_t own = all.size();
  if (with_last)
    for (const FaceRequest& request : last_)
      if (std::ranges::find(all, request.key, &FaceRequest::key) == all.end()) all.push_back(request);
  ShadowAtlas trial = atlas_;
  const FacePlaces places = trial.place(size, all);
  if (all.size() > own && (places.shrunk > 0 || places.left_out > 0)) return false;
  for (std::size_t i = 0; i < placed_.size(); ++i)
    if (places.squares[i] != placed_[i].square) return false;
  const std::size_t before = placed_.size();
  for (std::size_t i = 0; i < fresh.size(); ++i) {
    Placed placed{fresh[i], places.squares[before + i]};
    if (placed.square.size == 0) continue;
    placed.request.size = placed.square.size;
    placed_.push_back(placed);
  }
  atlas_ = std::move(trial);
  return true;
}

FacePlaces SharedPlaces::place(std::uint64_t frame, std::uint32_t size, std::span<const FaceRequest> requests) {
  if (frame != frame_) {
    last_.clear();
    for (const Placed& placed : placed_) last_.push_back(placed.request);
    placed_.clear();
    frame_ = frame;
  }
  std::vector<FaceRequest> fresh;
  for (const FaceRequest& request : requests)
    if (find(request.key) == nullptr) fresh.push_back(request);
  if (!try_place(size, fresh, true)) {
    // Earlier views keep their squares, so the fresh faces halve together until they fit.
    std::vector<FaceRequest> smaller = fresh;
    const auto halve = [&] {
      bool any = false;
      for (FaceRequest& request : smaller) {
        if (request.size <= GLOAM_SHADOW_SMALLEST_FACE) continue;
        request.size /= 2;
        any = true;
      }
      return any;
    };
    while (!try_place(size, smaller, false) && halve()) {
    }
  }
  FacePlaces places;
  for (const FaceRequest& request : fresh) {
    const Placed* placed = find(request.key);
    if (placed != nullptr && placed->request.size < request.size) ++places.shrunk;
  }
  for (const FaceRequest& request : requests) {
    const Placed* placed = find(request.key);
    places.squares.push_back(placed == nullptr ? AtlasSquare{} : placed->square);
    if (placed == nullptr) ++places.left_out;
  }
  return places;
}

}  // namespace gloam

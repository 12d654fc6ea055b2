// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <vector>

#include "modules/shadows/atlas/placement.h"

namespace gloam {

/// Places in an atlas that several views of a frame share, one view after another: captures, or a view and its
/// companions. A face that an earlier view of the
/// frame has placed keeps its square for later ones, at that view's size. Faces of the frame before keep their squares
/// while there is room. If a view's new faces find no room beside those of earlier views, they halve together; those
/// that still find none get no square. Both are counted.
class SharedPlaces {
 public:
  /// Announces a view that will place its faces in `frame`. A view counts once a frame.
  void join(std::uint64_t frame, std::uint32_t view);
  /// Number of views that joined the newest frame, at least 1.
  [[nodiscard]] std::uint32_t sharers() const;
  /// Places the faces of one view. frame: a number that differs from frame to frame. size: texels of the atlas' side.
  [[nodiscard]] FacePlaces place(std::uint64_t frame, std::uint32_t size, std::span<const FaceRequest> requests);
  [[nodiscard]] const ShadowAtlas& atlas() const { return atlas_; }
  /// Side of the atlas that the first view of a frame has chosen for all; 0: none has.
  void set_side(std::uint32_t texels) { side_ = texels; }
  [[nodiscard]] std::uint32_t side() const { return side_; }

 private:
  struct Placed {
    FaceRequest request;  ///< of the size that the face got
    AtlasSquare square;
  };
  [[nodiscard]] const Placed* find(const FaceKey& key) const;
  /// Places `fresh` beside the faces of earlier views, and those of the last frame if `with_last`. False if an earlier
  /// view's face would have to move, or if anything would have to shrink for the last frame's faces.
  [[nodiscard]] bool try_place(std::uint32_t size, std::span<const FaceRequest> fresh, bool with_last);

  ShadowAtlas atlas_;
  std::uint32_t side_ = 0;
  std::uint64_t joined_frame_ = ~0ull;
  std::vector<std::uint32_t> joined_;
  std::uint64_t frame_ = ~0ull;
  std::vector<Placed> placed_;     ///< in this frame, in order
  std::vector<FaceRequest> last_;  ///< of the frame before
};

/// The places that views of a world share, by ViewFaces::owner; a resource of the world. The views own them.
struct CapturePlaces {
  std::map<std::uint32_t, std::weak_ptr<SharedPlaces>> by_owner;
};

}  // namespace gloam

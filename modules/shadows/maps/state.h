// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <tuple>
#include <utility>
#include <vector>

#include "engine/core/result.h"
#include "engine/frame/transfers/upload.h"
#include "engine/gpu/device.h"
#include "modules/shadows/atlas/view_faces.h"
#include "modules/shadows/atlas/view_map_state.h"
#include "modules/shadows/knobs.h"
#include "modules/shadows/maps/scratch.h"

namespace gloam {

/// State of a view's maps outside the standard atlas (ShadowMapDrawer::draw_kept), after the last committed frame.
struct ExtraMapState {
  std::vector<std::pair<FaceKey, AtlasSquare>> places;
  ShadowCache cache;
  std::uint32_t size = 0;        ///< texels of the atlas' side
  AtlasSide side;                ///< changes in frames that are given up, too
  std::uint64_t last_frame = 0;  ///< Device::frame_number of its last use
};

/// The state of each view's maps, and the module's GPU memory without contents that outlive a frame: staging memory and
/// scratch images.
class ShadowStates {
 public:
  ShadowStates() = default;
  ~ShadowStates() { release(); }
  ShadowStates(const ShadowStates&) = delete;
  ShadowStates& operator=(const ShadowStates&) = delete;

  /// Call once per view and frame, before the other functions. Forgets views and turns, and destroys scratch images,
  /// that no frame has used for 120 frames.
  void begin(gpu::Device& device);
  /// The state of the atlas that holds these faces, empty at the first call. A view that shares an atlas at times has
  /// another state then: it is another image. world: its world_id. user: the view.
  [[nodiscard]] ViewMapState& view(std::uint64_t world, const ViewFaces& faces, ViewId user);
  /// The state; null if view() was never called for it, or if it has been forgotten since.
  [[nodiscard]] const ViewMapState* find(std::uint64_t world, const ViewFaces& faces) const;
  /// Decides whether the view has images of its own for its maps, or takes turns in the images of the world: views get
  /// their own in the order in which they came, while all of them fit in knobs.kept_atlas_bytes. Views with companions
  /// and captures always have their own, which they share among themselves.
  void choose_images(const ViewFaces& faces, const ShadowKnobs& knobs, ViewMapState& view) const;
  /// Views that take turns; those of all worlds.
  [[nodiscard]] std::size_t views_in_turns() const;
  /// Gives the images of a world to the view until the next view takes them. Returns whether they hold what the view
  /// has left there. frame: FrameGraph::frame.
  [[nodiscard]] bool take_turn(std::uint64_t world, const ViewMapState& view, const ShadowKnobs& knobs,
                               std::uint32_t frame);
  /// The frame in which the view has taken the images was committed.
  void commit_turn(std::uint64_t world, const ViewMapState& view, const ShadowKnobs& knobs);
  /// Frees scratch images and staging memory; the next frame takes what it needs.
  void free_idle_memory();
  /// Resets the state's counters and its list of drawn faces. For frames of the view that draw no maps.
  void skip_frame(std::uint64_t world, const ViewFaces& faces);
  /// The state of the view's maps outside the standard atlas; empty at the first call.
  [[nodiscard]] ExtraMapState& extra_maps(std::uint64_t world, ViewId view);
  /// Forgets what only this view uses.
  void release_view(ViewId view);
  /// Staging memory of this frame for copies into images.
  [[nodiscard]] UploadRing& staging() { return *staging_; }
  /// The same for traced visibilities, which may need many bytes. Its memory is released in the first frame that does
  /// not use it.
  [[nodiscard]] UploadRing& traced_staging();
  /// The scratch images, with room for a batch of `texels` texels. All worlds and views share them. Later calls in the
  /// same frame may replace the images: look them up while recording, not before.
  [[nodiscard]] Result<const ShadowScratch*> scratch(std::uint64_t texels);
  /// Forgets and destroys everything.
  void release();

 private:
  /// World, ViewFaces::owner, and whether views share the atlas.
  using Key = std::tuple<std::uint64_t, std::uint32_t, bool>;
  static Key key_of(std::uint64_t world, const ViewFaces& faces) {
    return {world, faces.owner.value, faces.shared != nullptr};
  }

  /// Images in which views take turns, and the views (ViewMapState::number) whose maps they hold.
  struct Turns {
    std::uint64_t holder = 0;      ///< after the last committed frame
    std::uint64_t last = 0;        ///< in the frame that is being declared
    std::uint32_t frame = 0;       ///< FrameGraph::frame of `last`
    std::uint64_t last_frame = 0;  ///< Device::frame_number of its last use
  };
  /// World, texels of the atlas' side, and whether maps have 16 bits.
  using TurnsKey = std::tuple<std::uint64_t, std::uint32_t, bool>;

  gpu::Device* device_ = nullptr;
  std::map<Key, ViewMapState> views_;
  std::uint64_t numbers_ = 0;  ///< views that came so far
  std::map<TurnsKey, Turns> turns_;
  std::map<std::pair<std::uint64_t, std::uint32_t>, ExtraMapState> extra_maps_;  ///< by world and view
  std::unique_ptr<UploadRing> staging_;
  std::unique_ptr<UploadRing> traced_staging_;
  bool has_traced_ = false;  ///< the newest frame used traced_staging()
  ShadowScratch scratch_;
  std::uint64_t scratch_frame_ = 0;  ///< frame of its last use
  std::uint64_t staging_frame_ = ~0ull;
};

}  // namespace gloam

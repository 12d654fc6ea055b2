// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "engine/frame/planning/plan.h"

namespace gloam::frame {

/// Places the barriers of a plan while the live passes are visited in order: begin_pass, the uses of the pass, and
/// finish after the last pass. Fills Plan::barriers and the barrier ranges of Plan::passes.
class BarrierPlacer {
 public:
  BarrierPlacer(const Declaration& declaration, Plan& plan);

  /// `time`: index of the pass in Plan::passes.
  void begin_pass(std::uint32_t time) { time_ = time; }
  void use(const DeclaredUse& use);
  /// Adds the barriers after the last pass, which leave each import ready for its `after` access, and orders all
  /// barriers by pass.
  void finish();

 private:
  /// The accesses of one resource, or of one mip of one layer, since its last barrier.
  struct Epoch {
    gpu::AccessMask accesses = 0;
    bool writes = false;
    bool used = false;              ///< a pass of this frame has used it
    std::uint32_t barrier = kNone;  ///< index of the epoch's barrier; kNone: an import's state before the frame
  };
  struct Track {
    std::uint32_t mips = 1;
    std::uint32_t layers = 1;
    std::vector<Epoch> epochs;  ///< one for the whole resource, or one per mip and layer (by mip, then layer)
    [[nodiscard]] bool split() const { return epochs.size() > 1; }
  };
  /// A barrier that one epoch of a track needs.
  struct Need {
    bool barrier = false;
    bool early = false;  ///< may stand before the first pass that uses the resource
    bool writes = false;
    gpu::AccessMask before = 0;
    gpu::AccessMask after = 0;
    bool operator==(const Need&) const = default;
  };

  [[nodiscard]] Need need_of(std::uint32_t resource, Epoch& epoch, gpu::AccessMask accesses, bool writes);
  void split(std::uint32_t resource);
  void add_barriers(std::uint32_t resource, std::vector<Need>& needs);
  std::uint32_t add_barrier(std::uint32_t resource, const gpu::ImageRange& range, const Need& need);
  std::uint32_t join(const PlannedBarrier& barrier, std::uint32_t time);
  void order_barriers();

  const Declaration& declaration_;
  Plan& plan_;
  std::vector<Track> tracks_;         ///< by resource
  std::vector<std::uint32_t> times_;  ///< of each barrier: index of its pass; the number of passes: after the last one
  std::vector<Need> needs_;
  std::uint32_t time_ = 0;
};

}  // namespace gloam::frame

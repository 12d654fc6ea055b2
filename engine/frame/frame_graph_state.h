// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "engine/frame/declaration.h"
#include "engine/frame/frame_graph.h"
#include "engine/frame/pass_timer.h"
#include "engine/frame/planning/plan_cache.h"

namespace gloam {

/// The members of FrameGraph, for the source files that implement it: frame_graph.cpp, execute.cpp and describe.cpp.
struct FrameGraph::State {
  enum class Stage { declaring, compiled, executed };

  explicit State(gpu::Device& d) : device(d), cache(d) {}

  /// The resource of a handle of this frame; asserts for other handles.
  template <class Kind>
  [[nodiscard]] frame::DeclaredResource& resource(FrameRef<Kind> ref) {
    GLOAM_ASSERT(ref, "this handle names no resource");
    GLOAM_ASSERT(ref.frame == frame_number && ref.resource < declaration.resources.size(),
                 "this handle is of another frame; handles are made anew every frame");
    return declaration.resources[ref.resource];
  }
  /// Adds an access of a pass to a resource. Returns the resource's version after the access.
  template <class Kind>
  std::uint32_t add_use(std::uint32_t pass, FrameRef<Kind> ref, gpu::Access access, bool write,
                        const gpu::ImageRange& range = {});
  /// `range` with counts; the default range if it is the whole image.
  [[nodiscard]] gpu::ImageRange range_of_use(frame::DeclaredResource& image, const gpu::ImageRange& range) const;
  /// Asserts that the pass that is being recorded has declared this version of the resource.
  template <class Kind>
  void check_declared(FrameRef<Kind> ref);

  /// Whether a pass of the plan writes the resource.
  [[nodiscard]] bool writes(std::uint32_t resource_index) const;

  void check_declaring() const {
    GLOAM_ASSERT(stage == Stage::declaring, "declarations come between FrameGraph::begin and FrameGraph::compile");
  }
  void record_barriers(gpu::CommandList& commands, std::uint32_t first, std::uint32_t end);
  [[nodiscard]] gpu::ImageHandle image_of(std::uint32_t resource_index) const;
  [[nodiscard]] gpu::BufferHandle buffer_of(std::uint32_t resource_index) const;

  gpu::Device& device;
  frame::Declaration declaration;
  frame::PlanCache cache;
  frame::PassTimer timer;
  Stage stage = Stage::declaring;
  std::uint32_t frame_number = 1;
  std::uint64_t hash = 0;
  frame::CachedPlan* plan = nullptr;  ///< plan of this frame; null before compile
  gpu::AccessMask other_plans = 0;    ///< what the first barriers of transients wait for besides their plan's users
  std::uint32_t recording_pass = frame::kNone;
  std::uint32_t view = 0;  ///< of the passes that are being added
  Status recorded;         ///< of the last execute
  std::vector<gpu::BufferBarrier> buffer_barriers;
  std::vector<gpu::ImageBarrier> image_barriers;
};

}  // namespace gloam

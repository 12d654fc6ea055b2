// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "engine/ecs/world.h"
#include "engine/math/types.h"
#include "engine/render/draws/draw_lists.h"
#include "engine/render/view.h"
#include "shaders/render/deform_shared.h"
#include "shaders/render/draw_shared.h"

namespace gloam {

/// A mesh instance in a drawn frame.
struct DrawnInstance {
  Entity entity;
  std::uint32_t mesh = 0;
  std::uint32_t skin = kNone;
  dmat4 world_from_mesh = dmat4(1.0);
  dvec3 skin_origin = dvec3(0.0);  ///< JointMatrices::Range::origin
  std::uint32_t first_joint = 0;   ///< into DrawnInstances::joints
  std::uint32_t joint_count = 0;   ///< 0: not skinned
  std::uint32_t first_weight = 0;  ///< into DrawnInstances::weights
  std::uint32_t weight_count = 0;
};

/// The mesh instances of a world in one drawn frame, with the data that deforms them.
struct DrawnInstances {
  std::uint64_t assets_version = 0;   ///< SceneAssets::version
  std::uint64_t assets_revision = 0;  ///< SceneAssets::revision()
  std::vector<DrawnInstance> items;   ///< ordered by entity.index
  std::vector<mat4> joints;           ///< JointMatrices::matrices
  std::vector<float> weights;         ///< MorphWeights::values

  /// The instance of an entity. Null if the frame did not draw the entity, or with another mesh, skin or assets than
  /// the world has.
  [[nodiscard]] const DrawnInstance* find(const World& world, Entity entity) const;
};

/// Keeps data of the last drawn frame for the motion of the next one: the camera of each view and, while some module
/// needs motion, the instances of each world. A frame that is given up changes nothing. For one thread.
///
/// Previous deformed vertices are not kept: a frame with motion deforms the vertices that it draws a second time, with
/// the previous joints and weights. So they exist for vertices that the previous frame did not draw, too.
class MotionHistory {
 public:
  /// Begins a frame. with_instances: some view needs motion. is_redraw: draws the world's last frame again, which then
  /// has the same previous frame; its commit does nothing.
  void begin_frame(const World& world, std::uint64_t slot, bool with_instances, bool is_redraw);
  /// Sets the previous camera of a view of the frame.
  void begin_view(RenderView& view);
  /// The previous frame's instances; empty if it had none. Only between begin_frame(with_instances) and commit.
  [[nodiscard]] const DrawnInstances& instances() const;
  /// Ends a frame that was submitted. Clears Teleports.
  void commit(World& world);

  void forget_world(std::uint64_t slot) { worlds_.erase(slot); }
  void forget_view(ViewId view);

 private:
  struct DrawnView {
    ViewCamera camera;
    ViewCamera previous;  ///< RenderView::previous
    bool has_previous = false;
  };
  struct WorldState {
    std::map<std::uint32_t, DrawnView> views;  ///< of the last frame, by id
    DrawnInstances last;
    DrawnInstances before_last;
  };
  std::map<std::uint64_t, WorldState> worlds_;
  // Of the frame that was begun:
  std::uint64_t slot_ = 0;
  bool with_instances_ = false;
  bool is_redraw_ = false;
  std::map<std::uint32_t, DrawnView> views_;
};

/// Push constants of a draw with motion. drawn: the instance in the previous frame; null: it was at rest.
[[nodiscard]] shaders::MotionDrawConstants motion_draw_constants(const Draw& draw, const FrameDraws& lists,
                                                                 const RenderView& view, const DrawnInstance* drawn);

/// Where the previous frame's data begin in the buffers of a deform pass, behind those of the current frame.
struct DeformOffsets {
  std::uint32_t joints = 0;
  std::uint32_t weights = 0;
};
/// Constants that deform a primitive as in the previous frame; null `drawn`, or an instance with other joints or
/// weights: as in the current one.
[[nodiscard]] shaders::DeformConstants previous_deform_constants(const DeformJob& job, const DrawnInstance* drawn,
                                                                 const DeformOffsets& offsets);

}  // namespace gloam

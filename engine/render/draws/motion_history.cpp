// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/draws/motion_history.h"

#include <algorithm>
#include <utility>

#include "engine/core/assert.h"
#include "engine/ecs/view.h"
#include "engine/scene/assets.h"
#include "engine/scene/resources.h"

namespace gloam {
namespace {

const JointMatrices::Range* joints_of(const JointMatrices& joints, Entity entity) {
  const auto range = std::ranges::lower_bound(joints.ranges, entity.index, {},
                                              [](const JointMatrices::Range& r) { return r.instance.index; });
  return range != joints.ranges.end() && range->instance == entity ? &*range : nullptr;
}

/// The world's instances as the current frame draws them.
DrawnInstances drawn_instances(const World& world) {
  DrawnInstances drawn;
  const JointMatrices& joints = world.resource<JointMatrices>();
  drawn.assets_version = world.resource<SceneAssets>().version;
  drawn.assets_revision = world.resource<SceneAssets>().revision();
  drawn.joints = joints.matrices;
  drawn.weights = world.resource<MorphWeights>().values;
  world.view<const MeshInstance, const WorldTransform, Maybe<const MorphInstance>>().each(
      [&](Entity entity, const MeshInstance& mesh, const WorldTransform& transform, const MorphInstance* morph) {
        DrawnInstance& item = drawn.items.emplace_back();
        item.entity = entity;
        item.mesh = mesh.mesh;
        item.skin = mesh.skin;
        item.world_from_mesh = transform.matrix;
        if (const JointMatrices::Range* range = mesh.skin == kNone ? nullptr : joints_of(joints, entity)) {
          item.skin_origin = range->origin;
          item.first_joint = range->first;
          item.joint_count = range->count;
        }
        if (morph != nullptr) {
          item.first_weight = morph->first;
          item.weight_count = morph->count;
        }
      });
  std::ranges::sort(drawn.items, {}, [](const DrawnInstance& item) { return item.entity.index; });
  return drawn;
}

/// Whether the entity or one of its ancestors is in the list.
bool is_listed(const World& world, Entity entity, const std::vector<Entity>& list) {
  while (true) {
    if (std::ranges::find(list, entity) != list.end()) return true;
    const Parent* parent = world.try_get<Parent>(entity);
    if (parent == nullptr) return false;
    entity = parent->entity;
  }
}

/// Whether the instance can be deformed with its previous joints and weights.
bool has_pose(const DrawnInstance* drawn, const shaders::DeformConstants& constants) {
  return drawn != nullptr && (constants.skinned == 0 || drawn->joint_count > 0) &&
         drawn->weight_count >= constants.morph_targets;
}

}  // namespace

const DrawnInstance* DrawnInstances::find(const World& world, Entity entity) const {
  const auto item =
      std::ranges::lower_bound(items, entity.index, {}, [](const DrawnInstance& i) { return i.entity.index; });
  if (item == items.end() || item->entity != entity) return nullptr;
  const MeshInstance* now = world.try_get<MeshInstance>(entity);
  const SceneAssets& assets = world.resource<SceneAssets>();
  const bool same = now != nullptr && now->mesh == item->mesh && now->skin == item->skin &&
                    assets.version == assets_version && assets.revision(AssetKind::mesh, now->mesh) <= assets_revision;
  return same ? &*item : nullptr;
}

void MotionHistory::begin_frame(const World& world, std::uint64_t slot, bool with_instances, bool is_redraw) {
  slot_ = slot;
  with_instances_ = with_instances;
  is_redraw_ = is_redraw;
  views_.clear();
  const Teleports* teleports = world.try_resource<Teleports>();
  if (is_redraw || teleports == nullptr || teleports->entities.empty()) return;
  std::erase_if(worlds_[slot].last.items,
                [&](const DrawnInstance& item) { return is_listed(world, item.entity, teleports->entities); });
}

void MotionHistory::begin_view(RenderView& view) {
  WorldState& state = worlds_[slot_];
  const auto last = state.views.find(view.id.value);
  const bool known = last != state.views.end();
  if (is_redraw_) {
    if (known) view.previous = last->second.previous;
    view.has_previous = known && last->second.has_previous;
    return;
  }
  view.has_previous = known && !view.camera_cut();
  if (view.has_previous) view.previous = last->second.camera;
  views_[view.id.value] = {view.view_camera(), view.previous, view.has_previous};
}

const DrawnInstances& MotionHistory::instances() const {
  GLOAM_ASSERT(with_instances_, "previous instances are kept only in frames that need motion");
  const WorldState& state = worlds_.at(slot_);
  return is_redraw_ ? state.before_last : state.last;
}

void MotionHistory::commit(World& world) {
  if (is_redraw_) return;
  WorldState& state = worlds_[slot_];
  state.views = std::move(views_);
  state.before_last = with_instances_ ? std::move(state.last) : DrawnInstances{};
  state.last = with_instances_ ? drawn_instances(world) : DrawnInstances{};
  if (Teleports* teleports = world.try_resource<Teleports>()) teleports->entities.clear();
}

void MotionHistory::forget_view(ViewId view) {
  for (auto& [slot, state] : worlds_) state.views.erase(view.value);
}

shaders::MotionDrawConstants motion_draw_constants(const Draw& draw, const FrameDraws& lists, const RenderView& view,
                                                   const DrawnInstance* drawn) {
  shaders::DrawConstants previous = draw.constants;
  const shaders::DeformConstants deform =
      draw.deform == kNone ? shaders::DeformConstants{} : lists.deforms[draw.deform].constants;
  if (!has_pose(drawn, deform)) {
    const dvec3 moved = view.position - view.previous.position;
    previous.row0.w = static_cast<float>(previous.row0.w + moved.x);
    previous.row1.w = static_cast<float>(previous.row1.w + moved.y);
    previous.row2.w = static_cast<float>(previous.row2.w + moved.z);
  } else {
    dmat4 matrix = from_origin(drawn->world_from_mesh, *draw.primitive);
    if (deform.skinned != 0) {
      matrix = dmat4(1.0);
      matrix[3] = dvec4(drawn->skin_origin, 1.0);
    }
    previous = draw_constants(matrix, view.previous.position);
  }
  return {draw.constants, previous.row0, previous.row1, previous.row2};
}

shaders::DeformConstants previous_deform_constants(const DeformJob& job, const DrawnInstance* drawn,
                                                   const DeformOffsets& offsets) {
  shaders::DeformConstants constants = job.constants;
  if (!has_pose(drawn, constants)) return constants;
  constants.first_joint = offsets.joints + drawn->first_joint;
  constants.first_weight = offsets.weights + drawn->first_weight;
  return constants;
}

}  // namespace gloam

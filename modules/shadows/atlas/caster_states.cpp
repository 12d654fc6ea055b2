// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/atlas/caster_states.h"

#include <algorithm>
#include <bit>
#include <iterator>
#include <map>
#include <tuple>
#include <utility>

#include "engine/core/hash.h"
#include "engine/scene/resources.h"

namespace gloam {
namespace {

void add_floats(Hasher& hasher, std::span<const float> values) {
  for (const float value : values) hasher.value(std::bit_cast<std::uint32_t>(value));
}

/// Hash of the caster's position, pose, mesh and material.
std::uint64_t hash_of(const Caster& caster, std::uint64_t pose) {
  Hasher hasher;
  hasher.value(caster.primitive->first_index).value(caster.primitive->first_vertex).value(caster.primitive->material);
  hasher.value(caster.content).value(caster.cut_out_content);
  hasher.value(caster.variant.features).value(caster.subsurface).value(caster.levels).value(pose);
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 3; ++row) hasher.value(std::bit_cast<std::uint64_t>(caster.world_from_mesh[column][row]));
  return hasher.digest();
}

/// The hash of each range of joints, by the index of its first joint.
std::map<std::uint32_t, std::uint64_t> joint_hashes(const JointMatrices& joints) {
  std::map<std::uint32_t, std::uint64_t> hashes;
  for (const JointMatrices::Range& range : joints.ranges) {
    if (std::size_t{range.first} + range.count > joints.matrices.size()) continue;
    Hasher hasher;
    for (const mat4& matrix : std::span(joints.matrices).subspan(range.first, range.count))
      add_floats(hasher, {&matrix[0][0], 16});
    hashes[range.first] = hasher.digest();
  }
  return hashes;
}

std::uint64_t pose_of(const shaders::DeformConstants& deform, const std::map<std::uint32_t, std::uint64_t>& joints,
                      std::span<const float> weights) {
  Hasher hasher;
  if (deform.skinned != 0) {
    const auto found = joints.find(deform.first_joint);
    if (found == joints.end()) return 0;
    hasher.value(found->second);
  }
  if (deform.morph_targets > 0) {
    if (std::size_t{deform.first_weight} + deform.morph_targets > weights.size()) return 0;
    add_floats(hasher, weights.subspan(deform.first_weight, deform.morph_targets));
  }
  return std::max<std::uint64_t>(hasher.digest(), 1);
}

bool by_entity(Entity a, Entity b) { return std::tie(a.index, a.generation) < std::tie(b.index, b.generation); }

/// Whether both are the same, unchanged caster. The entities must be equal too: of two casters that look the same, one
/// may be withheld.
bool same(const CasterState& a, const CasterState& b) {
  return a.hash == b.hash && a.entity == b.entity && !a.unsteady && !b.unsteady;
}

bool by_hash(const CasterState* a, const CasterState* b) {
  return a->hash != b->hash ? a->hash < b->hash : by_entity(a->entity, b->entity);
}

/// Calls pair(state, equal) for each state of `a` with its equal in `b`, or null. Both are ordered by_hash.
template <class Pair>
void for_each_pair(std::span<const CasterState* const> a, std::span<const CasterState* const> b, const Pair& pair) {
  std::size_t at = 0;
  for (const CasterState* state : a) {
    while (at < b.size() && by_hash(b[at], state)) ++at;
    const bool equal = at < b.size() && same(*state, *b[at]);
    pair(state, equal ? b[at] : nullptr);
    if (equal) ++at;
  }
}

/// Appends the boxes of the casters in `here` that are not in `there`. The last `sources` states are in any order, the
/// states before them are ordered by entity.
void append_boxes(std::span<const Entity> here, std::span<const Entity> there, std::span<const CasterState> all,
                  std::size_t sources, std::vector<CasterBox>& boxes) {
  const std::span<const CasterState> states = all.first(all.size() - sources);
  std::vector<Entity> turned;
  std::set_difference(here.begin(), here.end(), there.begin(), there.end(), std::back_inserter(turned), by_entity);
  for (const Entity entity : turned) {
    auto at = std::lower_bound(states.begin(), states.end(), entity,
                               [](const CasterState& state, Entity e) { return by_entity(state.entity, e); });
    for (; at != states.end() && at->entity == entity; ++at) boxes.push_back(at->box);
    for (const CasterState& source : all.last(sources))
      if (source.entity == entity) boxes.push_back(source.box);
  }
}

/// Sources that come, go or change their content do not wait for a turn. The first `gone` boxes are old ones.
void end_turns(std::vector<CasterBox>& boxes, std::size_t gone) {
  const std::span<CasterBox> all(boxes), old = all.first(gone), now = all.subspan(gone);
  const auto lacks = [](std::span<const CasterBox> there, const CasterBox& box) {
    return std::ranges::none_of(there,
                                [&](const CasterBox& one) { return one.turns > 1 && one.content == box.content; });
  };
  std::vector<CasterBox*> ended;
  for (CasterBox& box : old)
    if (box.turns > 1 && lacks(now, box)) ended.push_back(&box);
  for (CasterBox& box : now)
    if (box.turns > 1 && lacks(old, box)) ended.push_back(&box);
  for (CasterBox* box : ended) box->turns = 1;
}

/// The lights with withheld casters in either, ascending.
std::vector<Entity> lights_of(const WithheldCasters& a, const WithheldCasters& b) {
  std::vector<Entity> lights;
  for (const WithheldCasters* withheld : {&a, &b})
    for (const WithheldCasters::OfLight& of_light : withheld->lights) lights.push_back(of_light.light);
  std::sort(lights.begin(), lights.end(), by_entity);
  lights.erase(std::unique(lights.begin(), lights.end()), lights.end());
  return lights;
}

}  // namespace

bool holds_caster(std::span<const Entity> list, Entity caster) {
  return !list.empty() && std::binary_search(list.begin(), list.end(), caster, by_entity);
}

std::vector<std::uint64_t> caster_poses(const World& world, const FrameDraws& draws) {
  const std::vector<Caster>& casters = draws.casters.casters;
  std::vector<std::uint64_t> poses(casters.size(), 0);
  if (draws.deforms.empty()) return poses;
  const std::map<std::uint32_t, std::uint64_t> joints = joint_hashes(world.resource<JointMatrices>());
  const std::vector<float>& weights = world.resource<MorphWeights>().values;
  for (std::size_t i = 0; i < casters.size(); ++i)
    if (casters[i].deform != kNone) poses[i] = pose_of(draws.deforms[casters[i].deform].constants, joints, weights);
  return poses;
}

std::vector<CasterState> caster_states(std::span<const Caster> casters, std::span<const std::uint64_t> poses,
                                       JobExecutor& executor) {
  std::vector<CasterState> states(casters.size());
  executor.parallel_for(casters.size(), 256, [&](JobRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      const std::uint64_t pose = poses.empty() ? 0 : poses[i];
      states[i].hash = hash_of(casters[i], pose);
      states[i].unsteady = casters[i].moving && pose == 0;
      states[i].box = {casters[i].bounds_min, casters[i].bounds_max, casters[i].emissive_reach_m};
      states[i].entity = casters[i].entity;
    }
  });
  return states;
}

std::vector<CasterState> source_states(std::span<const CasterSource* const> sources) {
  std::vector<CasterState> states;
  for (const CasterSource* source : sources) {
    const WorldBox box = source->bounds.known() ? source->bounds : WorldBox{};
    Hasher hasher;
    hasher.value(source->content_hash);
    for (const dvec3& corner : {box.min, box.max})
      for (int axis = 0; axis < 3; ++axis) hasher.value(std::bit_cast<std::uint64_t>(corner[axis]));
    const std::uint32_t turns = source->content_hash == 0 ? 1 : source->turns;
    states.push_back({hasher.digest(),
                      source->changes_every_frame(),
                      {box.min, box.max, 0.0, turns, turns > 1 ? source->content_hash : 0},
                      source->entity});
  }
  return states;
}

CasterHistory CasterHistory::advanced(std::vector<CasterState> states, std::size_t sources) const {
  CasterHistory next;
  next.frame_ = frame_ + 1;
  next.since_.assign(states.size(), next.frame_);
  // Most casters are unchanged and at the same index.
  std::vector<const CasterState*> gone, come;
  for (std::size_t i = 0; i < std::max(states.size(), states_.size()); ++i) {
    if (i < states.size() && i < states_.size() && same(states[i], states_[i])) {
      next.since_[i] = since_[i];
      continue;
    }
    if (i < states_.size()) gone.push_back(&states_[i]);
    if (i < states.size()) come.push_back(&states[i]);
  }
  std::sort(gone.begin(), gone.end(), by_hash);
  std::sort(come.begin(), come.end(), by_hash);
  const auto add_changed = [&](const CasterState& state) {
    next.changed_.push_back(state.box);
    next.changed_casters_.push_back(state.entity);
  };
  for_each_pair(gone, come, [&](const CasterState* state, const CasterState* equal) {
    if (equal == nullptr) add_changed(*state);
  });
  next.gone_ = next.changed_.size();
  for_each_pair(come, gone, [&](const CasterState* state, const CasterState* equal) {
    if (equal == nullptr) add_changed(*state);
    if (equal != nullptr)
      next.since_[static_cast<std::size_t>(state - states.data())] =
          since_[static_cast<std::size_t>(equal - states_.data())];
  });
  end_turns(next.changed_, next.gone_);
  next.states_ = std::move(states);
  next.sources_ = sources;
  next.next_withheld_ = next.withheld_ = next_withheld_;
  for (const Entity light : lights_of(withheld_, next.withheld_))
    next.changed_of_.push_back({light, next.find_changed(light, *this)});
  return next;
}

std::uint64_t CasterHistory::withheld_hash(Entity light) const {
  const std::span<const CasterState> all(states_), meshes = all.first(all.size() - sources_);
  const std::span<const Entity> casters = withheld_.of(light);
  Hasher hasher;
  const auto add = [&](const CasterState& state) {
    hasher.value(state.entity.index).value(state.hash).value(state.unsteady ? frame_ : 0);
  };
  for (const Entity entity : casters) {
    auto at = std::ranges::lower_bound(meshes, entity, by_entity, &CasterState::entity);
    for (; at != meshes.end() && at->entity == entity; ++at) add(*at);
  }
  for (const CasterState& source : all.last(sources_))
    if (holds_caster(casters, source.entity)) add(source);
  return hasher.digest();
}

std::vector<CasterBox> CasterHistory::find_changed(Entity light, const CasterHistory& before) const {
  const std::span<const Entity> left_before = before.withheld_.of(light), left_now = withheld_.of(light);
  std::vector<CasterBox> boxes;
  for (std::size_t i = 0; i < changed_.size(); ++i)
    if (!holds_caster(i < gone_ ? left_before : left_now, changed_casters_[i])) boxes.push_back(changed_[i]);
  // A caster that becomes withheld was in the map before; one that is no longer withheld is in it now.
  append_boxes(left_now, left_before, before.states_, before.sources_, boxes);
  append_boxes(left_before, left_now, states_, sources_, boxes);
  return boxes;
}

std::span<const CasterBox> CasterHistory::changed(Entity light) const {
  const auto found = std::lower_bound(changed_of_.begin(), changed_of_.end(), light,
                                      [](const Changed& a, Entity b) { return by_entity(a.light, b); });
  return found != changed_of_.end() && found->light == light ? std::span<const CasterBox>(found->boxes) : changed_;
}

}  // namespace gloam

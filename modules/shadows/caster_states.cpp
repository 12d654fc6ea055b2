// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/caster_states.h"

#include <algorithm>
#include <bit>
#include <map>
#include <utility>

#include "engine/core/hash.h"
#include "engine/scene/resources.h"

namespace gloam {
namespace {

void add(Hasher& hasher, std::span<const float> values) {
  for (const float value : values) hasher.value(std::bit_cast<std::uint32_t>(value));
}

/// Where the caster is and what it is made of; the meshes' and materials' own content has a version, which is part of the salt.
std::uint64_t hash_of(const Caster& caster, std::uint64_t pose) {
  Hasher hasher;
  hasher.value(caster.primitive->first_index).value(caster.primitive->first_vertex).value(caster.primitive->material);
  hasher.value(caster.variant.features).value(pose);
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 3; ++row) hasher.value(std::bit_cast<std::uint64_t>(caster.world_from_mesh[column][row]));
  return hasher.digest();
}

/// Of each range of joints, by its first.
std::map<std::uint32_t, std::uint64_t> joint_hashes(const JointMatrices& joints) {
  std::map<std::uint32_t, std::uint64_t> hashes;
  for (const JointMatrices::Range& range : joints.ranges) {
    if (std::size_t{range.first} + range.count > joints.matrices.size()) continue;
    Hasher hasher;
    for (const mat4& matrix : std::span(joints.matrices).subspan(range.first, range.count))
      add(hasher, {&matrix[0][0], 16});
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
    add(hasher, weights.subspan(deform.first_weight, deform.morph_targets));
  }
  return std::max<std::uint64_t>(hasher.digest(), 1);
}

bool same(const CasterState& a, const CasterState& b) { return a.hash == b.hash && !a.unsteady && !b.unsteady; }

/// Calls pair(one of `a`, its equal in `b` or none); both ordered by hash.
template <class Pair>
void for_each_pair(std::span<const CasterState* const> a, std::span<const CasterState* const> b, const Pair& pair) {
  std::size_t at = 0;
  for (const CasterState* state : a) {
    while (at < b.size() && b[at]->hash < state->hash) ++at;
    const bool equal = at < b.size() && same(*state, *b[at]);
    pair(state, equal ? b[at] : nullptr);
    if (equal) ++at;
  }
}

}  // namespace

std::vector<std::uint64_t> caster_poses(const World& world, const DrawLists& draws) {
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
      states[i].box = {casters[i].bounds_min, casters[i].bounds_max};
    }
  });
  return states;
}

void CasterHistory::advance(std::vector<CasterState> states) {
  // Most stand where they stood, at the same place of the list.
  std::vector<const CasterState*> gone, come;
  ++frame_;
  std::vector<std::uint64_t> since(states.size(), frame_);
  for (std::size_t i = 0; i < std::max(states.size(), states_.size()); ++i) {
    if (i < states.size() && i < states_.size() && same(states[i], states_[i])) {
      since[i] = since_[i];
      continue;
    }
    if (i < states_.size()) gone.push_back(&states_[i]);
    if (i < states.size()) come.push_back(&states[i]);
  }
  const auto by_hash = [](const CasterState* a, const CasterState* b) { return a->hash < b->hash; };
  std::sort(gone.begin(), gone.end(), by_hash);
  std::sort(come.begin(), come.end(), by_hash);
  changed_.clear();
  for_each_pair(gone, come, [&](const CasterState* state, const CasterState* equal) {
    if (equal == nullptr) changed_.push_back(state->box);
  });
  for_each_pair(come, gone, [&](const CasterState* state, const CasterState* equal) {
    if (equal == nullptr) changed_.push_back(state->box);
    if (equal != nullptr)
      since[static_cast<std::size_t>(state - states.data())] = since_[static_cast<std::size_t>(equal - states_.data())];
  });
  states_ = std::move(states);
  since_ = std::move(since);
}

}  // namespace gloam

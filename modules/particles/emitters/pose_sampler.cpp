// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/particles/emitters/pose_sampler.h"

#include <array>
#include <glm/ext/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <span>

namespace gloam {
namespace {

dmat4 matrix_of(const LocalTransform& pose) {
  return glm::translate(dmat4(1.0), pose.translation) * glm::mat4_cast(pose.rotation) *
         glm::scale(dmat4(1.0), pose.scale);
}

/// Sets one property of the pose to the channel's value at the time.
void sample_property(const AnimationChannel& channel, double time_s, LocalTransform& pose) {
  std::array<double, 4> value{};
  if (channel.width > value.size() || channel.path == AnimationPath::weights) return;
  sample_channel(channel, time_s, std::span(value.data(), channel.width));
  if (channel.path == AnimationPath::rotation)
    pose.rotation = dquat(value[3], value[0], value[1], value[2]);
  else
    (channel.path == AnimationPath::translation ? pose.translation : pose.scale) = dvec3(value[0], value[1], value[2]);
}

}  // namespace

PoseSampler::PoseSampler(const PlacingView& nodes, const AnimationBindings& bindings, const SceneAssets& assets)
    : nodes_(nodes), assets_(assets) {
  for (const AnimationBinding& binding : bindings.poses)
    if (binding.clip < assets.clips.size() && binding.channel < assets.clips[binding.clip].channels.size())
      channels_[binding.entity].push_back(binding);
}

Entity PoseSampler::parent_of(Entity node) const {
  const Parent* parent = nodes_.try_get<const Parent>(node);
  const bool exists = parent != nullptr && nodes_.try_get<const WorldTransform>(parent->entity) != nullptr;
  return exists ? parent->entity : kNoEntity;
}

bool PoseSampler::moves(Entity node) const {
  if (channels_.empty()) return false;
  for (; node != kNoEntity; node = parent_of(node))
    if (channels_.contains(node)) return true;
  return false;
}

dmat4 PoseSampler::world_from_node(Entity node, double time_s) const {
  dmat4 matrix(1.0);
  for (; node != kNoEntity; node = parent_of(node)) {
    const LocalMatrix* fixed = nodes_.try_get<const LocalMatrix>(node);
    const LocalTransform* now = nodes_.try_get<const LocalTransform>(node);
    const WorldTransform* placed = nodes_.try_get<const WorldTransform>(node);
    if (fixed != nullptr) {
      matrix = fixed->matrix * matrix;
    } else if (now != nullptr) {
      LocalTransform pose = *now;
      if (const auto found = channels_.find(node); found != channels_.end())
        for (const AnimationBinding& binding : found->second) {
          const AnimationClip& clip = assets_.clips[binding.clip];
          sample_property(clip.channels[binding.channel], looped_time(time_s, double{clip.duration_s}), pose);
        }
      matrix = matrix_of(pose) * matrix;
    } else if (parent_of(node) == kNoEntity && placed != nullptr) {
      matrix = placed->matrix * matrix;  // the host places it
    }
  }
  return matrix;
}

}  // namespace gloam

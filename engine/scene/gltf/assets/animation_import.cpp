// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/scene/gltf/assets/animation_import.h"

#include <algorithm>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "engine/core/text/nearest_name.h"
#include "engine/scene/gltf/buffers/accessor_read.h"
#include "engine/scene/gltf/place.h"

namespace gloam::gltf {
namespace {

using Target = std::pair<std::uint32_t, AnimationPath>;

std::optional<AnimationPath> path_of(std::string_view text) {
  if (text == "translation") return AnimationPath::translation;
  if (text == "rotation") return AnimationPath::rotation;
  if (text == "scale") return AnimationPath::scale;
  if (text == "weights") return AnimationPath::weights;
  return std::nullopt;
}

Interpolation interpolation_of(std::string_view text) {
  if (text == "STEP") return Interpolation::step;
  return text == "CUBICSPLINE" ? Interpolation::cubic : Interpolation::linear;
}

std::uint32_t target_count(const Document& document, std::uint32_t node) {
  const NodeSource& source = document.nodes[node];
  const std::uint32_t mesh = source.mesh == kNone ? source.instanced_mesh : source.mesh;
  if (mesh == kNone || document.meshes[mesh].primitives.empty()) return 0;
  return static_cast<std::uint32_t>(document.meshes[mesh].primitives[0].targets.size());
}

Error animation_fault(std::string sentence) { return {ErrorKind::input, std::move(sentence)}; }

Status read_keys(const Document& document, const AnimationSource::Sampler& sampler, AnimationChannel& channel) {
  const Accessor& input = document.accessors[sampler.input];
  const Accessor& output = document.accessors[sampler.output];
  if (input.components != 1 || input.component_type != ComponentType::f32)
    return animation_fault("its times (" + place("accessor", sampler.input) + ") must be floats");
  const std::uint32_t components = channel.path == AnimationPath::weights ? 1 : channel.width;
  const std::uint64_t values = channel.interpolation == Interpolation::cubic ? 3 : 1;
  const std::uint64_t wanted = input.count * values * (channel.path == AnimationPath::weights ? channel.width : 1);
  if (output.components != components || output.count != wanted)
    return animation_fault("its values (" + place("accessor", sampler.output) + ") must be " + std::to_string(wanted) +
                           " of " + std::to_string(components) + " components, are " + std::to_string(output.count) +
                           " of " + std::to_string(output.components));
  channel.times.resize(input.count);
  GLOAM_TRY(read_floats(document, sampler.input, channel.times));
  if (std::adjacent_find(channel.times.begin(), channel.times.end(), std::greater_equal<>()) != channel.times.end())
    return animation_fault("its times (" + place("accessor", sampler.input) + ") must increase strictly");
  if (channel.times.front() < 0.0f)
    return animation_fault("its times (" + place("accessor", sampler.input) + ") must be ≥ 0");
  channel.values.resize(output.count * output.components);
  return read_floats(document, sampler.output, channel.values);
}

/// Imports one channel; empty if an extension defines its path.
Result<std::optional<AnimationChannel>> import_channel(const Document& document, const AnimationSource& animation,
                                                       const AnimationSource::Channel& source) {
  AnimationChannel channel;
  const std::optional<AnimationPath> path = path_of(source.path);
  if (!path) return std::optional<AnimationChannel>();  // check_extensions has refused required ones
  channel.node = source.node;
  channel.path = *path;
  channel.width = *path == AnimationPath::rotation  ? 4
                  : *path == AnimationPath::weights ? target_count(document, source.node)
                                                    : 3;
  if (channel.width == 0)
    return animation_fault("it moves the weights of node " + std::to_string(source.node) +
                           ", which has no morph targets");
  const AnimationSource::Sampler& sampler = animation.samplers[source.sampler];
  channel.interpolation = interpolation_of(sampler.interpolation);
  GLOAM_TRY(read_keys(document, sampler, channel));
  return std::optional<AnimationChannel>(std::move(channel));
}

/// Clip indices in the order in which clips claim the properties that they animate.
Result<std::vector<std::size_t>> claim_order(const Document& document, std::string_view preferred) {
  std::vector<std::size_t> order;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < document.animations.size(); ++i) {
    order.push_back(i);
    names.push_back(one_line(document.animations[i].name));
  }
  if (preferred.empty()) return order;
  const auto found =
      std::find_if(order.begin(), order.end(), [&](std::size_t i) { return document.animations[i].name == preferred; });
  if (found == order.end())
    return Error{ErrorKind::usage,
                 "no animation is named " + in_quotes(preferred) + "; " + valid_names(preferred, names)};
  std::rotate(order.begin(), found, found + 1);
  return order;
}

}  // namespace

Result<std::vector<Skin>> import_skins(const Document& document) {
  std::vector<Skin> skins;
  for (const SkinSource& source : document.skins) {
    Skin skin;
    skin.name = source.name;
    skin.joint_nodes = source.joints;
    if (source.inverse_bind != kNone) GLOAM_TRY(read_vectors(document, source.inverse_bind, skin.inverse_bind));
    skin.inverse_bind.resize(source.joints.size(), mat4(1.0f));
    skins.push_back(std::move(skin));
  }
  return skins;
}

Result<std::vector<AnimationClip>> import_animations(Document& document, std::string_view preferred,
                                                     const std::vector<bool>& used) {
  const Result<std::vector<std::size_t>> order = claim_order(document, preferred);
  if (!order) return order.error();
  std::vector<AnimationClip> clips(document.animations.size());
  std::set<Target> claimed;
  for (const std::size_t index : *order) {
    const AnimationSource& source = document.animations[index];
    const std::string where = place("animation", index, source.name);
    AnimationClip& clip = clips[index];
    clip.name = source.name;
    for (std::size_t c = 0; c < source.channels.size(); ++c) {
      const std::uint32_t node = source.channels[c].node;
      if (node == kNone) continue;
      Result<std::optional<AnimationChannel>> channel = import_channel(document, source, source.channels[c]);
      if (!channel) return fault_at(where + ", " + place("channel", c), channel.error().message);
      if (!channel->has_value()) continue;
      clip.duration_s = std::max(clip.duration_s, (*channel)->times.back());
      if (!used[node]) continue;
      if (document.nodes[node].matrix && (*channel)->path != AnimationPath::weights) {
        document.warnings.push_back(where + ": node " + std::to_string(node) +
                                    " is a sheared matrix, it stays as it is");
        continue;
      }
      if (claimed.emplace(node, (*channel)->path).second) clip.channels.push_back(std::move(**channel));
    }
  }
  return clips;
}

}  // namespace gloam::gltf

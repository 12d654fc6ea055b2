// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/output/identity.h"

#include <cstdio>
#include <span>

#include "engine/core/hash.h"
#include "engine/scene/assets.h"
#include "sandbox/output/file_io.h"

namespace gloam {
namespace {

std::string hexadecimal(std::uint64_t value) {
  char digits[17];
  std::snprintf(digits, sizeof(digits), "%016llx", static_cast<unsigned long long>(value));
  return digits;
}

/// Hashes the bytes of the items: T must have no padding.
template <class T>
void add_items(Hasher& hasher, const std::vector<T>& items) {
  hasher.value(items.size()).bytes(std::as_bytes(std::span(items)));
}

void add_primitive(Hasher& hasher, const Primitive& primitive) {
  hasher.value(primitive.material);
  add_items(hasher, primitive.positions);
  add_items(hasher, primitive.normals);
  add_items(hasher, primitive.tangents);
  add_items(hasher, primitive.uv0);
  add_items(hasher, primitive.uv1);
  add_items(hasher, primitive.colors);
  add_items(hasher, primitive.joints);
  add_items(hasher, primitive.weights);
  add_items(hasher, primitive.indices);
  for (const Primitive::MorphTarget& target : primitive.morph_targets) {
    add_items(hasher, target.positions);
    add_items(hasher, target.normals);
  }
}

void add_assets(Hasher& hasher, const SceneAssets& assets) {
  for (const Mesh& mesh : assets.meshes) {
    for (const Primitive& primitive : mesh.primitives) add_primitive(hasher, primitive);
  }
  for (const Image& image : assets.images) {
    hasher.value(image.width).value(image.height);
    add_items(hasher, image.rgba);
  }
  for (const AnimationClip& clip : assets.clips) {
    for (const AnimationChannel& channel : clip.channels) {
      add_items(hasher, channel.times);
      add_items(hasher, channel.values);
    }
  }
}

}  // namespace

std::string scene_hash(const std::string& scene, const World& world) {
  Hasher hasher;
  // A built-in scene has no file: hash its name instead.
  const auto file = read_text_file(scene, ErrorKind::input);
  hasher.text(file ? *file : scene);
  add_assets(hasher, world.resource<SceneAssets>());
  return hexadecimal(hasher.digest());
}

std::string program_hash() {
  const auto program = read_text_file("/proc/self/exe", ErrorKind::failed);
  return program ? hexadecimal(Hasher().text(*program).digest()) : std::string();
}

}  // namespace gloam

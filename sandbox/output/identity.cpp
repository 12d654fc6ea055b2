// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/output/identity.h"

#include <array>
#include <cstdio>

#include "engine/scene/assets/hash.h"
#include "sandbox/output/file_io.h"

namespace gloam {
namespace {

std::string hexadecimal(std::uint64_t value) {
  char digits[17];
  std::snprintf(digits, sizeof(digits), "%016llx", static_cast<unsigned long long>(value));
  return digits;
}

void add_primitive(Hasher& hasher, const Primitive& primitive) {
  hasher.value(primitive.material);
  hash_triangles(hasher, primitive);
  hasher.items(primitive.joints);
  hasher.items(primitive.weights);
  for (const Primitive::MorphTarget& target : primitive.morph_targets) {
    hasher.items(target.positions);
    hasher.items(target.normals);
  }
}

void add_assets(Hasher& hasher, const SceneAssets& assets) {
  for (const Mesh& mesh : assets.meshes) {
    for (const Primitive& primitive : mesh.primitives) add_primitive(hasher, primitive);
  }
  for (const Image& image : assets.images) hash_image(hasher, image);
  for (const AnimationClip& clip : assets.clips) {
    for (const AnimationChannel& channel : clip.channels) {
      hasher.items(channel.times);
      hasher.items(channel.values);
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

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/scene/assets/hash.h"

namespace gloam {

void hash_triangles(Hasher& hasher, const Primitive& primitive) {
  hasher.items(primitive.positions);
  hasher.items(primitive.normals);
  hasher.items(primitive.tangents);
  hasher.items(primitive.uv0);
  hasher.items(primitive.uv1);
  hasher.items(primitive.colors);
  hasher.items(primitive.indices);
}

void hash_image(Hasher& hasher, const Image& image) {
  hasher.value(image.width).value(image.height);
  hasher.items(image.rgba);
}

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/hash.h"
#include "engine/scene/assets.h"

namespace gloam {

/// Hashes the triangles of a primitive at rest: indices, and all vertex attributes but joints and weights.
void hash_triangles(Hasher& hasher, const Primitive& primitive);
/// Hashes size and texels.
void hash_image(Hasher& hasher, const Image& image);

}  // namespace gloam

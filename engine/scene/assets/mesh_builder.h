// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/assets.h"

namespace gloam {

/// Fills in what a primitive made by code may lack, and keeps what it has. Positions are required; all other streams
/// are optional.
/// - indices: 0, 1, 2, …
/// - normals: at each vertex the mean of its faces, weighted by their area; triangles that share no vertices are flat
/// - tangents, if there are texture coordinates for `normal_texture`: along growing u
/// - bounds
/// Streams of wrong lengths and indices out of range are asserted.
void complete_primitive(Primitive& primitive, const TextureSlot* normal_texture = nullptr);

/// complete_primitive() for all primitives, with tangents where the material has a normal texture, and the bounds of
/// the mesh.
void complete_mesh(Mesh& mesh, const SceneAssets& assets);

}  // namespace gloam

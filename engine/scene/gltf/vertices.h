// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "engine/scene/assets.h"

namespace gloam::gltf {

/// Makes new vertex i a copy of old vertex sources[i], in every array of the primitive. Indices stay as they are.
void gather_vertices(Primitive& primitive, std::span<const std::uint32_t> sources);

/// Drops vertices that no index names, when indices are fewer than vertices: primitives may share one large array.
void drop_unused_vertices(Primitive& primitive);

/// Gives every corner a vertex of its own and the face's normal (+Y where a triangle has no area).
void make_flat_normals(Primitive& primitive);

/// Scales normals to unit length. Those that have none become the area-weighted normal of the faces around the vertex,
/// else +Y; returns how many those were.
std::uint32_t repair_normals(Primitive& primitive);

/// Unit tangents from the derivatives of the normal texture's coordinates (transform included), weighted by the
/// corners' angles; any direction across the normal where those say nothing. A vertex whose faces are partly mirrored
/// is split.
void make_tangents(Primitive& primitive, const TextureSlot& normal_texture);

/// Scales tangents to unit length across the normal and handedness to ±1.
void repair_tangents(Primitive& primitive);

}  // namespace gloam::gltf

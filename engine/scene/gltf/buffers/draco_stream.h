// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "engine/core/result.h"
#include "engine/scene/gltf/document.h"

namespace gloam::gltf {

/// An attribute that is wanted of a compressed mesh.
struct DracoAttribute {
  std::string name;      ///< for messages: "POSITION (accessor 3)"
  std::uint32_t id = 0;  ///< unique id in the compressed mesh
  ComponentType type = ComponentType::f32;
  std::uint32_t components = 1;
  std::uint64_t count = 0;           ///< elements that the accessor states
  std::vector<std::uint8_t> values;  ///< result: packed elements, one per vertex
};

/// A compressed mesh, and what the file's accessors say of it.
struct DracoMesh {
  std::span<const std::uint8_t> stream;
  std::uint32_t index_accessor = kNone;    ///< kNone: no accessor states how many indices there are
  std::uint64_t index_count = 0;           ///< of index_accessor
  std::vector<DracoAttribute> attributes;  ///< at least one
  std::vector<std::uint32_t> indices;      ///< result: three per triangle, each below the number of vertices
};

/// Decodes the mesh. memory_left: bytes that decoding may take; what it takes is subtracted. The counts of the stream
/// are compared with those of the accessors and with memory_left before anything of their size is allocated. Input
/// error as in decompress_meshes; the message holds only the fault, not the place.
[[nodiscard]] Status decode_draco(DracoMesh& mesh, std::uint64_t& memory_left);

}  // namespace gloam::gltf

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/scene/gltf/buffers/compressed_meshes.h"

#include <cstring>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/scene/gltf/buffers/draco_stream.h"
#include "engine/scene/gltf/place.h"
#include "engine/scene/gltf/validation/document_check.h"

namespace gloam::gltf {
namespace {

constexpr int kTriangleList = 4;
constexpr int kStripOfTriangles = 5;

Error mesh_fault(std::string sentence) { return {ErrorKind::input, std::move(sentence)}; }

/// The primitive's accessor of an attribute; null if the importer does not read attributes of this name.
std::uint32_t* accessor_of(PrimitiveSource& primitive, std::string_view name) {
  const std::pair<std::string_view, std::uint32_t*> attributes[] = {
      {"POSITION", &primitive.position}, {"NORMAL", &primitive.normal},    {"TANGENT", &primitive.tangent},
      {"TEXCOORD_0", &primitive.uv0},    {"TEXCOORD_1", &primitive.uv1},   {"COLOR_0", &primitive.color},
      {"JOINTS_0", &primitive.joints},   {"WEIGHTS_0", &primitive.weights}};
  for (const auto& [known, accessor] : attributes)
    if (known == name && *accessor != kNone) return accessor;
  return nullptr;
}

Result<std::span<const std::uint8_t>> stream_of(const Document& document, std::uint32_t index) {
  const BufferView& view = document.views[index];
  const std::span<const std::uint8_t> buffer = document.buffers[view.buffer];
  if (view.offset > buffer.size() || view.length > buffer.size() - view.offset)
    return mesh_fault(place("buffer view", index) + " ends past its buffer of " + std::to_string(buffer.size()) +
                      " bytes");
  return buffer.subspan(view.offset, view.length);
}

/// Appends a buffer, a view of it and an accessor, and returns the accessor's index.
std::uint32_t append(Document& document, std::vector<std::uint8_t> bytes, Accessor accessor) {
  accessor.view = static_cast<std::uint32_t>(document.views.size());
  accessor.offset = 0;
  accessor.sparse.reset();
  document.views.push_back({static_cast<std::uint32_t>(document.buffers.size()), 0, bytes.size(), 0, {}});
  document.buffers.push_back(std::move(bytes));
  document.accessors.push_back(accessor);
  return static_cast<std::uint32_t>(document.accessors.size() - 1);
}

/// The mesh that the primitive's accessors describe.
Result<DracoMesh> describe(const Document& document, PrimitiveSource& primitive) {
  const CompressedMesh& compressed = *primitive.compressed;
  if (primitive.mode != kTriangleList && primitive.mode != kStripOfTriangles)
    return mesh_fault("mode must be 4 or 5, is " + std::to_string(primitive.mode));
  const Result<std::span<const std::uint8_t>> stream = stream_of(document, compressed.view);
  if (!stream) return stream.error();
  DracoMesh mesh;
  mesh.stream = *stream;
  if (primitive.indices != kNone && primitive.mode == kTriangleList) {
    mesh.index_accessor = primitive.indices;
    mesh.index_count = document.accessors[primitive.indices].count;
  }
  for (const auto& [name, id] : compressed.attributes) {
    const std::uint32_t* index = accessor_of(primitive, name);
    if (index == nullptr) continue;
    const Accessor& accessor = document.accessors[*index];
    const std::string where = name + " (" + place("accessor", *index) + ")";
    if (accessor.components < 1 || accessor.components > 4 || component_size(accessor.component_type) == 0)
      return mesh_fault(where + " is of a type that no attribute has");
    mesh.attributes.push_back({where, id, accessor.component_type, accessor.components, accessor.count, {}});
  }
  if (mesh.attributes.empty()) return mesh_fault("it names no attribute of the primitive");
  return mesh;
}

Status decompress(Document& document, PrimitiveSource& primitive, std::uint64_t& memory_left) {
  Result<DracoMesh> mesh = describe(document, primitive);
  if (!mesh) return mesh.error();
  GLOAM_TRY(decode_draco(*mesh, memory_left));
  std::size_t next = 0;
  for (const auto& [name, id] : primitive.compressed->attributes) {
    std::uint32_t* const index = accessor_of(primitive, name);
    if (index == nullptr) continue;
    Accessor accessor = document.accessors[*index];
    accessor.decoded_for = *index;
    *index = append(document, std::move(mesh->attributes[next++].values), accessor);
  }
  std::vector<std::uint8_t> bytes(mesh->indices.size() * sizeof(std::uint32_t));
  std::memcpy(bytes.data(), mesh->indices.data(), bytes.size());
  Accessor indices;
  indices.count = mesh->indices.size();
  indices.component_type = ComponentType::u32;
  indices.decoded_for = primitive.indices;
  primitive.indices = append(document, std::move(bytes), indices);
  primitive.mode = kTriangleList;
  return {};
}

}  // namespace

Status decompress_meshes(Document& document, std::uint64_t file_bytes) {
  std::uint64_t left = import_budget(bytes_read(document, file_bytes));
  for (std::size_t m = 0; m < document.meshes.size(); ++m) {
    MeshSource& mesh = document.meshes[m];
    for (std::size_t p = 0; p < mesh.primitives.size(); ++p) {
      PrimitiveSource& primitive = mesh.primitives[p];
      if (!primitive.compressed || primitive.position == kNone) continue;
      if (const Status status = decompress(document, primitive, left); !status)
        return fault_at(place("mesh", m, mesh.name) + ", " + place("primitive", p) + ", KHR_draco_mesh_compression",
                        status.error().message);
    }
  }
  return {};
}

}  // namespace gloam::gltf

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/scene/gltf/validation/document_check.h"

#include <algorithm>
#include <limits>
#include <string>

#include "engine/scene/gltf/place.h"

namespace gloam::gltf {
namespace {

// The import may take kFreeBytes, plus kBytesPerByte for each byte read: an index of 2 bytes can give a vertex of 100
// bytes. A limit is needed because any number of primitives and channels may share one accessor.
constexpr std::uint64_t kFreeBytes = std::uint64_t{512} << 20;
constexpr std::uint64_t kBytesPerByte = 64;

/// Memory that the import may still take.
struct Budget {
  std::uint64_t file_bytes = 0;
  std::uint64_t left = 0;

  Status take(std::uint64_t bytes, const std::string& where) {
    if (bytes > left)
      return fault_at(where, "its counts ask for more memory than " + std::to_string(file_bytes) + " bytes justify");
    left -= bytes;
    return {};
  }
};

bool is_index_type(ComponentType type) {
  return type == ComponentType::u8 || type == ComponentType::u16 || type == ComponentType::u32;
}

/// Whether `count` elements, `stride` bytes apart from `offset` on, lie in `length` bytes. Element sizes and strides
/// are below 2^10, counts below 2^32, so only the offset can overflow a sum.
bool fits(std::uint64_t offset, std::uint64_t count, std::uint64_t stride, std::uint64_t element,
          std::uint64_t length) {
  return offset <= length && (count - 1) * stride + element <= length - offset;
}

Status check_view(const Document& document, std::size_t i) {
  const BufferView& view = document.views[i];
  const std::uint64_t size = document.buffers[view.buffer].size();
  if (view.length == 0) return fault_at(place("buffer view", i), "byteLength must be ≥ 1");
  if (view.offset > size || view.length > size - view.offset)
    return fault_at(place("buffer view", i), "it ends past its buffer of " + std::to_string(size) + " bytes");
  return {};
}

Status check_sparse(const Document& document, const Accessor& accessor, const std::string& where) {
  const SparseSource& sparse = *accessor.sparse;
  if (sparse.count == 0 || sparse.count > accessor.count)
    return fault_at(
        where, "sparse.count must be in 1…" + std::to_string(accessor.count) + ", is " + std::to_string(sparse.count));
  if (!is_index_type(sparse.index_type)) return fault_at(where, "sparse indices must be unsigned integers");
  const std::uint64_t index_size = component_size(sparse.index_type);
  if (!fits(sparse.index_offset, sparse.count, index_size, index_size, document.views[sparse.index_view].length))
    return fault_at(where, "its sparse indices end past their buffer view");
  const std::uint64_t size = component_size(accessor.component_type) * std::max(accessor.components, 1u);
  if (!fits(sparse.value_offset, sparse.count, size, size, document.views[sparse.value_view].length))
    return fault_at(where, "its sparse values end past their buffer view");
  return {};
}

Status check_accessor(const Document& document, std::size_t i) {
  const Accessor& accessor = document.accessors[i];
  const std::string where = place("accessor", i);
  if (component_size(accessor.component_type) == 0)
    return fault_at(where, "componentType " + std::to_string(static_cast<std::uint32_t>(accessor.component_type)) +
                               " is not one of glTF");
  if (accessor.count == 0 || accessor.count > std::numeric_limits<std::uint32_t>::max())
    return fault_at(where, "count must be in 1…4294967295, is " + std::to_string(accessor.count));
  if (accessor.view != kNone) {
    const BufferView& view = document.views[accessor.view];
    const std::uint64_t size = component_size(accessor.component_type) * std::max(accessor.components, 1u);
    const std::uint64_t stride = view.stride == 0 ? size : view.stride;
    if (stride < size)
      return fault_at(where, "byteStride " + std::to_string(stride) +
                                 " of its buffer view is less than an element of " + std::to_string(size) + " bytes");
    if (!fits(accessor.offset, accessor.count, stride, size, view.length))
      return fault_at(where, "it ends past its buffer view of " + std::to_string(view.length) + " bytes");
  }
  return accessor.sparse ? check_sparse(document, accessor, where) : Status();
}

/// Requirements of an attribute. It must also have one element per position.
struct Attribute {
  const char* name;
  std::uint32_t accessor;
  std::uint32_t components_min;
  std::uint32_t components_max;
  bool integer = false;
};

Status check_attribute(const Document& document, const Attribute& attribute, std::uint64_t count,
                       const std::string& where) {
  if (attribute.accessor == kNone) return {};
  const Accessor& accessor = document.accessors[attribute.accessor];
  const std::uint32_t number = accessor.decoded_for == kNone ? attribute.accessor : accessor.decoded_for;
  const std::string name = std::string(attribute.name) + " (" + place("accessor", number) + ")";
  if (accessor.components < attribute.components_min || accessor.components > attribute.components_max)
    return fault_at(where, name + " must have " + std::to_string(attribute.components_max) + " components");
  const bool integer = accessor.component_type == ComponentType::u8 || accessor.component_type == ComponentType::u16;
  if (attribute.integer && !integer) return fault_at(where, name + " must be 8- or 16-bit unsigned integers");
  if (accessor.count != count)
    return fault_at(where, name + " has " + std::to_string(accessor.count) + " elements, but there are " +
                               std::to_string(count) + " positions");
  return {};
}

Status check_primitive(const Document& document, const PrimitiveSource& primitive, const std::string& where) {
  if (primitive.mode < 0 || primitive.mode > 6)
    return fault_at(where, "mode must be in 0…6, is " + std::to_string(primitive.mode));
  if (primitive.position == kNone) return {};
  const std::uint64_t count = document.accessors[primitive.position].count;
  const Attribute attributes[] = {{"POSITION", primitive.position, 3, 3},     {"NORMAL", primitive.normal, 3, 3},
                                  {"TANGENT", primitive.tangent, 4, 4},       {"TEXCOORD_0", primitive.uv0, 2, 2},
                                  {"TEXCOORD_1", primitive.uv1, 2, 2},        {"COLOR_0", primitive.color, 3, 4},
                                  {"JOINTS_0", primitive.joints, 4, 4, true}, {"WEIGHTS_0", primitive.weights, 4, 4}};
  for (const Attribute& attribute : attributes) GLOAM_TRY(check_attribute(document, attribute, count, where));
  for (std::size_t i = 0; i < primitive.targets.size(); ++i) {
    const std::string target = where + ", " + place("target", i);
    GLOAM_TRY(check_attribute(document, {"POSITION", primitive.targets[i].position, 3, 3}, count, target));
    GLOAM_TRY(check_attribute(document, {"NORMAL", primitive.targets[i].normal, 3, 3}, count, target));
  }
  if (primitive.indices == kNone) return {};
  const Accessor& indices = document.accessors[primitive.indices];
  if (indices.components != 1 || !is_index_type(indices.component_type) || indices.normalized)
    return fault_at(where, "indices (" + place("accessor", primitive.indices) + ") must be unsigned integers");
  return {};
}

/// Upper bound of the imported primitive's bytes: at worst, every corner of every triangle gets its own vertex.
std::uint64_t geometry_bytes(const Document& document, const PrimitiveSource& primitive) {
  if (primitive.position == kNone || primitive.mode < 4) return 0;
  const std::uint64_t vertices = document.accessors[primitive.position].count;
  const std::uint64_t listed = primitive.indices == kNone ? vertices : document.accessors[primitive.indices].count;
  const std::uint64_t corners = primitive.mode == 4 ? listed : 3 * listed;
  std::uint64_t vertex = sizeof(vec3) * 2 + sizeof(vec4) + sizeof(std::uint32_t);
  if (primitive.uv0 != kNone) vertex += sizeof(vec2);
  if (primitive.uv1 != kNone) vertex += sizeof(vec2);
  if (primitive.color != kNone) vertex += sizeof(vec4);
  if (primitive.joints != kNone) vertex += sizeof(vec4) + sizeof(std::uint64_t);
  for (const PrimitiveSource::Target& target : primitive.targets)
    vertex += sizeof(vec3) * (target.normal != kNone ? 2 : 1);
  // The positions are counted too: without a view, no byte of the file backs them.
  return corners * vertex + vertices * sizeof(vec3);
}

Status check_mesh(const Document& document, std::size_t i, Budget& budget) {
  const MeshSource& mesh = document.meshes[i];
  const std::string where = place("mesh", i, mesh.name);
  for (std::size_t p = 0; p < mesh.primitives.size(); ++p) {
    GLOAM_TRY(check_primitive(document, mesh.primitives[p], where + ", " + place("primitive", p)));
    if (mesh.primitives[p].targets.size() != mesh.primitives[0].targets.size())
      return fault_at(where, "its primitives differ in their number of morph targets");
    GLOAM_TRY(budget.take(geometry_bytes(document, mesh.primitives[p]), where));
  }
  const std::size_t targets = mesh.primitives.empty() ? 0 : mesh.primitives[0].targets.size();
  if (!mesh.weights.empty() && mesh.weights.size() != targets)
    return fault_at(where, "it has " + std::to_string(mesh.weights.size()) + " weights, but " +
                               std::to_string(targets) + " morph targets");
  return {};
}

Status check_skin(const Document& document, std::size_t i, Budget& budget) {
  const SkinSource& skin = document.skins[i];
  const std::string where = place("skin", i, skin.name);
  if (skin.joints.empty()) return fault_at(where, "it has no joints");
  if (skin.inverse_bind == kNone) return {};
  const Accessor& accessor = document.accessors[skin.inverse_bind];
  if (accessor.components != 16 || accessor.component_type != ComponentType::f32)
    return fault_at(where, "inverseBindMatrices must be 4×4 float matrices");
  if (accessor.count < skin.joints.size())
    return fault_at(where, "it has " + std::to_string(accessor.count) + " inverse bind matrices for " +
                               std::to_string(skin.joints.size()) + " joints");
  return budget.take(accessor.count * sizeof(mat4), where);
}

Status check_animation(const Document& document, std::size_t i, Budget& budget) {
  const AnimationSource& animation = document.animations[i];
  const std::string where = place("animation", i, animation.name);
  for (const AnimationSource::Channel& channel : animation.channels) {
    if (channel.sampler >= animation.samplers.size())
      return fault_at(where, "a channel's sampler is " + std::to_string(channel.sampler) + ", but it has " +
                                 std::to_string(animation.samplers.size()) + " samplers");
    const AnimationSource::Sampler& sampler = animation.samplers[channel.sampler];
    const Accessor& output = document.accessors[sampler.output];
    const std::uint64_t floats = document.accessors[sampler.input].count + output.count * output.components;
    GLOAM_TRY(budget.take(floats * sizeof(float), where));
  }
  return {};
}

}  // namespace

std::uint64_t component_size(ComponentType type) {
  switch (type) {
    case ComponentType::i8:
    case ComponentType::u8:
      return 1;
    case ComponentType::i16:
    case ComponentType::u16:
      return 2;
    case ComponentType::u32:
    case ComponentType::f32:
      return 4;
  }
  return 0;
}

std::uint64_t bytes_read(const Document& document, std::uint64_t file_bytes) {
  for (std::size_t i = 0; i < document.file_buffers; ++i) file_bytes += document.buffers[i].size();
  return file_bytes;
}

std::uint64_t import_budget(std::uint64_t bytes_read) { return kFreeBytes + kBytesPerByte * bytes_read; }

Status check_document(const Document& document, std::uint64_t file_bytes) {
  Budget budget{.file_bytes = bytes_read(document, file_bytes)};
  budget.left = import_budget(budget.file_bytes);
  for (std::size_t i = 0; i < document.views.size(); ++i) GLOAM_TRY(check_view(document, i));
  for (std::size_t i = 0; i < document.accessors.size(); ++i) GLOAM_TRY(check_accessor(document, i));
  for (std::size_t i = 0; i < document.meshes.size(); ++i) GLOAM_TRY(check_mesh(document, i, budget));
  for (std::size_t i = 0; i < document.skins.size(); ++i) GLOAM_TRY(check_skin(document, i, budget));
  for (std::size_t i = 0; i < document.animations.size(); ++i) GLOAM_TRY(check_animation(document, i, budget));
  return {};
}

}  // namespace gloam::gltf

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/scene/gltf/buffers/draco_stream.h"

#include <draco/compression/mesh/mesh_edgebreaker_decoder.h>
#include <draco/compression/mesh/mesh_sequential_decoder.h>
#include <draco/core/varint_decoding.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <optional>
#include <utility>

#include "engine/scene/gltf/validation/document_check.h"

// Draco's decoder allocates for the counts that a stream states, before it finds that the stream is too short for them.
// The decoders here stop at two places: before the triangles, whose counts are compared with the accessors and with the
// memory that is left, and before the values of attributes, whose number and sizes the stream states by then.

namespace gloam::gltf {
namespace {

// Upper bounds of what Draco allocates: corner tables and traversal lists of a triangle, tables of a triangle for each
// group of attributes with seams, and per vertex of each attribute its index and the two integers of each component.
constexpr std::uint64_t kBytesPerTriangle = 128;
constexpr std::uint64_t kBytesPerSeamTriangle = 40;
constexpr std::uint64_t kBytesPerAttributeValue = 16;
constexpr std::uint64_t kBytesPerComponent = 8;

Error stream_fault(std::string sentence) { return {ErrorKind::input, std::move(sentence)}; }

/// Decides what a stream may allocate. The first fault stays.
class Guard {
 public:
  Guard(const DracoMesh& mesh, std::uint64_t& memory_left) : mesh_(mesh), memory_left_(memory_left) {}

  /// Whether a stream with these counts may be decoded.
  bool allows_triangles(std::uint64_t triangles, std::uint64_t seams) {
    if (mesh_.index_accessor != kNone && triangles * 3 != mesh_.index_count)
      return refuse("it holds " + std::to_string(triangles) + " triangles, but its indices (accessor " +
                    std::to_string(mesh_.index_accessor) + ") have " + std::to_string(mesh_.index_count) + " elements");
    return takes(triangles, kBytesPerTriangle + kBytesPerSeamTriangle * seams, "triangles");
  }

  bool allows_vertices(std::uint64_t vertices) {
    for (const DracoAttribute& attribute : mesh_.attributes)
      if (attribute.count != vertices)
        return refuse("it holds " + std::to_string(vertices) + " vertices, but " + attribute.name + " has " +
                      std::to_string(attribute.count) + " elements");
    return true;
  }

  bool allows_attributes(const draco::PointCloud& points) {
    if (!allows_vertices(points.num_points())) return false;
    std::uint64_t bytes = 0;
    for (int i = 0; i < points.num_attributes(); ++i) {
      const draco::PointAttribute& attribute = *points.attribute(i);
      bytes += static_cast<std::uint64_t>(attribute.byte_stride()) + kBytesPerAttributeValue +
               kBytesPerComponent * static_cast<std::uint64_t>(attribute.num_components());
    }
    for (const DracoAttribute& attribute : mesh_.attributes)
      bytes += component_size(attribute.type) * attribute.components;
    return takes(points.num_points(), bytes, "vertices");
  }

  [[nodiscard]] const std::optional<std::string>& fault() const { return fault_; }

 private:
  bool refuse(std::string fault) {
    if (!fault_) fault_ = std::move(fault);
    return false;
  }

  bool takes(std::uint64_t count, std::uint64_t bytes, const std::string& name) {
    if (count > 0 && bytes > memory_left_ / count)
      return refuse("its " + name + " take more memory than the files justify");
    memory_left_ -= count * bytes;
    return true;
  }

  const DracoMesh& mesh_;
  std::uint64_t& memory_left_;
  std::optional<std::string> fault_;
};

/// A count in a stream. Streams before the given version hold a word, later ones a number of variable length.
bool read_count(draco::DecoderBuffer& buffer, std::uint16_t version, std::uint16_t first_with_varints,
                std::uint32_t& count) {
  if (version < first_with_varints) return buffer.Decode(&count);
  return draco::DecodeVarint(&count, &buffer);
}

/// The counts at the start of the triangles, read from a copy of the buffer. False if the stream ends.
bool allowed_by(Guard& guard, draco::DecoderBuffer buffer, std::uint16_t version, const draco::MeshSequentialDecoder&) {
  std::uint32_t triangles = 0;
  std::uint32_t vertices = 0;
  return read_count(buffer, version, DRACO_BITSTREAM_VERSION(2, 2), triangles) &&
         read_count(buffer, version, DRACO_BITSTREAM_VERSION(2, 2), vertices) && guard.allows_triangles(triangles, 0) &&
         guard.allows_vertices(vertices);
}

bool allowed_by(Guard& guard, draco::DecoderBuffer buffer, std::uint16_t version,
                const draco::MeshEdgebreakerDecoder&) {
  constexpr std::uint16_t kVarints = DRACO_BITSTREAM_VERSION(2, 0);
  std::uint32_t added = 0;
  std::uint32_t vertices = 0;
  std::uint32_t triangles = 0;
  std::uint8_t seams = 0;
  if (version < DRACO_BITSTREAM_VERSION(2, 2) && !read_count(buffer, version, kVarints, added)) return false;
  return read_count(buffer, version, kVarints, vertices) && read_count(buffer, version, kVarints, triangles) &&
         buffer.Decode(&seams) && guard.allows_triangles(triangles, seams);
}

/// A decoder that asks the guard.
template <class Decoder>
class GuardedDecoder : public Decoder {
 public:
  explicit GuardedDecoder(Guard& guard) : guard_(guard) {}

 protected:
  bool DecodeConnectivity() override {
    return allowed_by(guard_, *this->buffer(), this->bitstream_version(), *this) && Decoder::DecodeConnectivity();
  }
  bool DecodeAllAttributes() override {
    return guard_.allows_attributes(*this->point_cloud()) && Decoder::DecodeAllAttributes();
  }

 private:
  Guard& guard_;
};

std::unique_ptr<draco::MeshDecoder> make_decoder(const draco::DracoHeader& header, Guard& guard) {
  if (header.encoder_method == draco::MESH_SEQUENTIAL_ENCODING)
    return std::make_unique<GuardedDecoder<draco::MeshSequentialDecoder>>(guard);
  if (header.encoder_method == draco::MESH_EDGEBREAKER_ENCODING)
    return std::make_unique<GuardedDecoder<draco::MeshEdgebreakerDecoder>>(guard);
  return nullptr;
}

draco::DataType data_type_of(ComponentType type) {
  switch (type) {
    case ComponentType::i8:
      return draco::DT_INT8;
    case ComponentType::u8:
      return draco::DT_UINT8;
    case ComponentType::i16:
      return draco::DT_INT16;
    case ComponentType::u16:
      return draco::DT_UINT16;
    case ComponentType::u32:
      return draco::DT_UINT32;
    case ComponentType::f32:
      break;
  }
  return draco::DT_FLOAT32;
}

template <class T>
bool convert_value(const draco::PointAttribute& from, draco::AttributeValueIndex value, std::uint32_t components,
                   std::uint8_t* out) {
  T converted[4] = {};
  if (!from.ConvertValue<T>(value, static_cast<std::int8_t>(components), converted)) return false;
  std::memcpy(out, converted, components * sizeof(T));
  return true;
}

bool convert_value(const draco::PointAttribute& from, draco::AttributeValueIndex value, const DracoAttribute& to,
                   std::uint8_t* out) {
  switch (to.type) {
    case ComponentType::i8:
      return convert_value<std::int8_t>(from, value, to.components, out);
    case ComponentType::u8:
      return convert_value<std::uint8_t>(from, value, to.components, out);
    case ComponentType::i16:
      return convert_value<std::int16_t>(from, value, to.components, out);
    case ComponentType::u16:
      return convert_value<std::uint16_t>(from, value, to.components, out);
    case ComponentType::u32:
      return convert_value<std::uint32_t>(from, value, to.components, out);
    case ComponentType::f32:
      break;
  }
  return convert_value<float>(from, value, to.components, out);
}

bool is_finite(const std::uint8_t* bytes, std::uint32_t components) {
  for (std::uint32_t i = 0; i < components; ++i) {
    float value = 0.0f;
    std::memcpy(&value, bytes + i * sizeof(float), sizeof(float));
    if (!std::isfinite(value)) return false;
  }
  return true;
}

Status copy_attribute(const draco::Mesh& mesh, DracoAttribute& to) {
  const draco::PointAttribute* const from = mesh.GetAttributeByUniqueId(to.id);
  if (from == nullptr)
    return stream_fault(to.name.substr(0, to.name.find(' ')) + " is attribute " + std::to_string(to.id) +
                        " of the compressed mesh, which has none of this id");
  if (from->num_components() != static_cast<int>(to.components))
    return stream_fault(to.name + " has " + std::to_string(to.components) + " components, but attribute " +
                        std::to_string(to.id) + " of the compressed mesh has " +
                        std::to_string(from->num_components()));
  const std::size_t element = component_size(to.type) * to.components;
  const bool same = from->data_type() == data_type_of(to.type) && from->byte_stride() == static_cast<int>(element);
  to.values.resize(mesh.num_points() * element);
  for (std::uint32_t i = 0; i < mesh.num_points(); ++i) {
    std::uint8_t* const out = to.values.data() + i * element;
    const draco::AttributeValueIndex value = from->mapped_index(draco::PointIndex(i));
    const std::uint64_t end = (std::uint64_t{value.value()} + 1) * static_cast<std::uint64_t>(from->byte_stride());
    if (value.value() >= from->size() || end > from->buffer()->data_size())
      return stream_fault("it is damaged (" + to.name + ")");
    if (same)
      std::memcpy(out, from->GetAddress(value), element);
    else if (!convert_value(*from, value, to, out))
      return stream_fault("a value of " + to.name + " does not fit componentType " +
                          std::to_string(static_cast<std::uint32_t>(to.type)));
    if (to.type == ComponentType::f32 && !is_finite(out, to.components))
      return stream_fault("element " + std::to_string(i) + " of " + to.name + " is not finite");
  }
  return {};
}

Status copy_indices(const draco::Mesh& mesh, std::vector<std::uint32_t>& indices) {
  indices.reserve(std::size_t{mesh.num_faces()} * 3);
  for (std::uint32_t f = 0; f < mesh.num_faces(); ++f) {
    for (const draco::PointIndex& corner : mesh.face(draco::FaceIndex(f))) {
      if (corner.value() >= mesh.num_points())
        return stream_fault("its triangle " + std::to_string(f) + " refers to vertex " +
                            std::to_string(corner.value()) + ", but it has " + std::to_string(mesh.num_points()));
      indices.push_back(corner.value());
    }
  }
  return {};
}

}  // namespace

Status decode_draco(DracoMesh& mesh, std::uint64_t& memory_left) {
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(mesh.stream.data()), mesh.stream.size());
  draco::DracoHeader header;
  draco::DecoderBuffer header_buffer = buffer;
  if (!draco::PointCloudDecoder::DecodeHeader(&header_buffer, &header).ok()) return stream_fault("it is damaged");
  if (header.encoder_type != draco::TRIANGULAR_MESH) return stream_fault("it holds points, not triangles");
  Guard guard(mesh, memory_left);
  const std::unique_ptr<draco::MeshDecoder> decoder = make_decoder(header, guard);
  draco::Mesh decoded;
  const draco::DecoderOptions options;
  const bool whole = decoder != nullptr && decoder->Decode(options, &buffer, &decoded).ok();
  if (guard.fault()) return stream_fault(*guard.fault());
  if (!whole) return stream_fault("it is damaged");
  if (decoded.num_faces() == 0) return stream_fault("it holds no triangle");
  for (DracoAttribute& attribute : mesh.attributes) GLOAM_TRY(copy_attribute(decoded, attribute));
  return copy_indices(decoded, mesh.indices);
}

}  // namespace gloam::gltf

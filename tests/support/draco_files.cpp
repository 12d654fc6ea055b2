// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "tests/support/draco_files.h"

#include <draco/compression/encode.h>

#include <cstdlib>
#include <memory>

namespace gloam::test {
namespace {

draco::DataType data_type(int component_type) {
  switch (component_type) {
    case 5120:
      return draco::DT_INT8;
    case 5121:
      return draco::DT_UINT8;
    case 5122:
      return draco::DT_INT16;
    case 5123:
      return draco::DT_UINT16;
    case 5125:
      return draco::DT_UINT32;
    default:
      return draco::DT_FLOAT32;
  }
}

draco::GeometryAttribute::Type attribute_type(const std::string& name) {
  if (name == "POSITION") return draco::GeometryAttribute::POSITION;
  if (name == "NORMAL") return draco::GeometryAttribute::NORMAL;
  if (name == "COLOR_0") return draco::GeometryAttribute::COLOR;
  if (name.starts_with("TEXCOORD")) return draco::GeometryAttribute::TEX_COORD;
  return draco::GeometryAttribute::GENERIC;
}

void add_attributes(draco::PointCloud& points, std::span<const PlainAttribute> attributes) {
  points.set_num_points(static_cast<std::uint32_t>(attributes[0].count()));
  for (const PlainAttribute& attribute : attributes) {
    const std::size_t stride = attribute.bytes.size() / attribute.count();
    draco::GeometryAttribute form;
    form.Init(attribute_type(attribute.name), nullptr, static_cast<std::uint8_t>(attribute.components),
              data_type(attribute.component_type), attribute.normalized, static_cast<std::int64_t>(stride), 0);
    const int index = points.AddAttribute(form, true, static_cast<std::uint32_t>(attribute.count()));
    draco::PointAttribute* const values = points.attribute(index);
    values->set_unique_id(attribute.draco_id);
    for (std::uint32_t i = 0; i < attribute.count(); ++i)
      values->SetAttributeValue(draco::AttributeValueIndex(i), attribute.bytes.data() + i * stride);
  }
}

std::vector<std::uint8_t> bytes_of(const draco::Status& status, const draco::EncoderBuffer& buffer) {
  if (!status.ok()) std::abort();
  return {buffer.data(), buffer.data() + buffer.size()};
}

}  // namespace

std::size_t PlainAttribute::count() const {
  const std::size_t size = component_type <= 5121 ? 1 : component_type <= 5123 ? 2 : 4;
  return bytes.size() / (size * static_cast<std::size_t>(components));
}

std::vector<std::uint8_t> encode_draco(std::span<const PlainAttribute> attributes,
                                       std::span<const std::uint32_t> indices, const DracoSettings& settings) {
  draco::Mesh mesh;
  add_attributes(mesh, attributes);
  for (std::size_t i = 0; i + 2 < indices.size(); i += 3)
    mesh.AddFace({draco::PointIndex(indices[i]), draco::PointIndex(indices[i + 1]), draco::PointIndex(indices[i + 2])});
  if (settings.with_metadata) {
    auto metadata = std::make_unique<draco::GeometryMetadata>();
    metadata->AddEntryString("name", "lantern");
    mesh.AddMetadata(std::move(metadata));
  }
  draco::Encoder encoder;
  encoder.SetEncodingMethod(settings.edgebreaker ? draco::MESH_EDGEBREAKER_ENCODING : draco::MESH_SEQUENTIAL_ENCODING);
  if (settings.position_bits > 0)
    encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, settings.position_bits);
  draco::EncoderBuffer buffer;
  return bytes_of(encoder.EncodeMeshToBuffer(mesh, &buffer), buffer);
}

std::vector<std::uint8_t> encode_draco_points(std::span<const PlainAttribute> attributes) {
  draco::PointCloud points;
  add_attributes(points, attributes);
  draco::Encoder encoder;
  draco::EncoderBuffer buffer;
  return bytes_of(encoder.EncodePointCloudToBuffer(points, &buffer), buffer);
}

}  // namespace gloam::test

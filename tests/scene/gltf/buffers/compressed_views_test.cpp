// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/scene/gltf/buffers/compressed_views.h"

#include <gmock/gmock.h>
#include <meshoptimizer.h>

#include "tests/support/gltf_files.h"

namespace gloam {
namespace {

using test::GltfText;
using test::Import;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using Bytes = std::vector<std::uint8_t>;

template <class T>
Bytes encode_vertices(const std::vector<T>& vertices, std::size_t stride) {
  const std::size_t count = vertices.size() * sizeof(T) / stride;
  Bytes bytes(meshopt_encodeVertexBufferBound(count, stride));
  bytes.resize(meshopt_encodeVertexBuffer(bytes.data(), bytes.size(), vertices.data(), count, stride));
  return bytes;
}

Bytes encode_triangles(const std::vector<unsigned>& indices, std::size_t vertices) {
  Bytes bytes(meshopt_encodeIndexBufferBound(indices.size(), vertices));
  bytes.resize(meshopt_encodeIndexBuffer(bytes.data(), bytes.size(), indices.data(), indices.size()));
  return bytes;
}

/// A file with compressed views in buffer 0, whose decoded places are in the fallback buffer 1.
struct CompressedFile {
  /// Appends a view and an accessor of it and returns the index of both.
  int add(const Bytes& encoded, std::size_t stride, std::size_t count, const std::string& mode,
          const std::string& accessor) {
    while (bytes.size() % 4 != 0) bytes.push_back(0);
    const std::string size = std::to_string(stride * count);
    const std::string parent_stride =
        mode.starts_with("\"ATTRIBUTES") ? R"(, "byteStride": )" + std::to_string(stride) : std::string();
    const int view =
        gltf.add("bufferViews", R"({"buffer": 1, "byteOffset": )" + std::to_string(decoded) + R"(, "byteLength": )" +
                                    size + parent_stride +
                                    R"(, "extensions": {"EXT_meshopt_compression": {"buffer": 0, "byteOffset": )" +
                                    std::to_string(bytes.size()) + R"(, "byteLength": )" +
                                    std::to_string(encoded.size()) + R"(, "byteStride": )" + std::to_string(stride) +
                                    R"(, "count": )" + std::to_string(count) + R"(, "mode": )" + mode + "}}}");
    bytes.insert(bytes.end(), encoded.begin(), encoded.end());
    decoded += stride * count;
    gltf.add("accessors", R"({"bufferView": )" + std::to_string(view) + R"(, "count": )" + std::to_string(count) +
                              ", " + accessor + "}");
    return view;
  }

  void finish(const std::string& uri) {
    gltf.set("extensionsRequired", R"(["EXT_meshopt_compression", "KHR_mesh_quantization"])");
    gltf.add("buffers", R"({"byteLength": )" + std::to_string(bytes.size()) + uri + "}");
    gltf.add("buffers", R"({"byteLength": )" + std::to_string(decoded) +
                            R"(, "extensions": {"EXT_meshopt_compression": {"fallback": true}}})");
  }

  [[nodiscard]] std::string text() {
    finish(R"(, "uri": "data:application/octet-stream;base64,)" + test::base64(bytes) + "\"");
    return gltf.text();
  }

  GltfText gltf;
  Bytes bytes;
  std::size_t decoded = 0;
};

const std::vector<unsigned> kSquareTriangles = {0, 1, 2, 2, 1, 3};

/// Positions as 16-bit integers (KHR_mesh_quantization), normals through the octahedral filter.
void add_square(CompressedFile& file) {
  const std::vector<std::int16_t> positions = {0, 0, 0, 0, 100, 0, 0, 0, 0, 100, 0, 0, 100, 100, 0, 0};
  file.add(encode_vertices(positions, 8), 8, 4, R"("ATTRIBUTES")", R"("componentType": 5122, "type": "VEC3")");
  const std::vector<std::int8_t> normals = {0, 0, 127, 0, 0, 0, 127, 0, 0, 0, 127, 0, 0, 0, 127, 0};
  file.add(encode_vertices(normals, 4), 4, 4, R"("ATTRIBUTES", "filter": "OCTAHEDRAL")",
           R"("componentType": 5120, "type": "VEC3", "normalized": true)");
  file.add(encode_triangles(kSquareTriangles, 4), 2, 6, R"("TRIANGLES")", R"("componentType": 5123, "type": "SCALAR")");
  file.gltf.mesh(R"("POSITION": 0, "NORMAL": 1)", R"(, "indices": 2)");
}

void expect_square(const Import& import) {
  ASSERT_EQ(import.fault(), "");
  const Primitive& primitive = import.world.resource<SceneAssets>().meshes[0].primitives[0];
  EXPECT_EQ(primitive.positions.size(), 4u);
  EXPECT_EQ(primitive.bounds.max, vec3(100, 100, 0));
  EXPECT_THAT(primitive.normals, ::testing::Each(vec3(0, 0, 1)));
  EXPECT_EQ(primitive.indices.size(), 6u);
}

TEST(CompressedViews, quantised_vertices_and_triangles_are_decoded) {
  CompressedFile file;
  add_square(file);
  Import import;
  test::import_text(file.text(), import);
  expect_square(import);
}

TEST(CompressedViews, a_binary_file_may_hold_them) {
  CompressedFile file;
  add_square(file);
  file.finish("");
  const std::string json = file.gltf.text();
  const test::TemporaryFolder folder;
  Import import;
  Bytes glb = test::make_glb(json, file.bytes);
  glb.insert(glb.end(), {1, 2, 3});  // bytes behind the file are ignored
  test::import_file(folder.write("scene.glb", glb), import);
  expect_square(import);
}

TEST(CompressedViews, index_sequences_and_exponential_floats_are_decoded) {
  CompressedFile file;
  // A float is 2^E·M: 8 bits of exponent, 24 of mantissa.
  const auto number = [](int exponent, int mantissa) {
    return static_cast<std::uint32_t>(exponent) << 24 | (static_cast<std::uint32_t>(mantissa) & 0xffffffu);
  };
  const std::vector<std::uint32_t> positions = {0, 0, 0, number(1, 3), 0, 0, 0, number(-1, -5), 0};
  file.add(encode_vertices(positions, 12), 12, 3, R"("ATTRIBUTES", "filter": "EXPONENTIAL")",
           R"("componentType": 5126, "type": "VEC3")");
  const std::vector<unsigned> indices = {2, 0, 1};
  Bytes encoded(meshopt_encodeIndexSequenceBound(3, 3));
  encoded.resize(meshopt_encodeIndexSequence(encoded.data(), encoded.size(), indices.data(), 3));
  file.add(encoded, 4, 3, R"("INDICES")", R"("componentType": 5125, "type": "SCALAR")");
  file.gltf.mesh(R"("POSITION": 0)", R"(, "indices": 1)");
  Import import;
  test::import_text(file.text(), import);
  ASSERT_EQ(import.fault(), "");
  EXPECT_THAT(import.world.resource<SceneAssets>().meshes[0].primitives[0].positions,
              ElementsAre(vec3(0, -2.5f, 0), vec3(0, 0, 0), vec3(6, 0, 0)));
}

void expect_refused(CompressedFile& file, const std::string& fault) {
  Import import;
  test::import_text(file.text(), import);
  EXPECT_THAT(import.fault(), HasSubstr(fault));
}

TEST(CompressedViews, what_the_codec_cannot_hold_is_refused) {
  const std::string position = R"("componentType": 5126, "type": "VEC3")";
  const Bytes zeros(64);
  CompressedFile damaged;
  damaged.add(zeros, 12, 3, R"("ATTRIBUTES")", position);
  expect_refused(damaged, "buffer view 0, EXT_meshopt_compression: it is damaged");
  CompressedFile gigantic;
  gigantic.add(zeros, 252, 2000000000, R"("ATTRIBUTES")", position);
  expect_refused(gigantic, "count is 2000000000, which its 64 bytes cannot hold");
  CompressedFile stride;
  stride.add(zeros, 6, 3, R"("TRIANGLES")", position);
  expect_refused(stride, "byteStride 6 does not fit its mode");
  CompressedFile triangles;
  triangles.add(zeros, 2, 4, R"("TRIANGLES")", position);
  expect_refused(triangles, "count must be a multiple of 3");
  CompressedFile filter;
  filter.add(zeros, 12, 3, R"("ATTRIBUTES", "filter": "QUATERNION")", position);
  expect_refused(filter, "its filter does not fit");
  CompressedFile mode;
  mode.add(zeros, 12, 3, R"("POINTS")", position);
  expect_refused(mode, "mode must be one of ATTRIBUTES TRIANGLES INDICES");
  CompressedFile past;
  past.add(Bytes(8), 12, 3, R"("ATTRIBUTES")", position);
  past.bytes.resize(4);
  expect_refused(past, "it ends past its buffer of 4 bytes");
}

TEST(CompressedViews, a_view_of_the_fallback_buffer_needs_the_extension) {
  CompressedFile file;
  add_square(file);
  file.gltf.add("bufferViews", R"({"buffer": 1, "byteLength": 8})");
  expect_refused(file, "buffer view 3: it ends past its buffer");
}

}  // namespace
}  // namespace gloam

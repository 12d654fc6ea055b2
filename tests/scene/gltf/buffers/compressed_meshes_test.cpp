// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/scene/gltf/buffers/compressed_meshes.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/support/draco_files.h"
#include "tests/support/gltf_files.h"
#include "tests/support/scale.h"

namespace gloam {
namespace {

using test::DracoSettings;
using test::GltfText;
using test::Import;
using test::plain_attribute;
using test::PlainAttribute;
using ::testing::HasSubstr;
using Bytes = std::vector<std::uint8_t>;

constexpr std::uint32_t kSide = 9;  // vertices along a side of the test mesh
constexpr std::uint8_t kGrey[4] = {128, 128, 255, 255};

/// A mesh as plain arrays. All vertices differ.
struct PlainMesh {
  std::vector<PlainAttribute> attributes;
  std::vector<std::uint32_t> indices;
};

/// A bumpy square with all attributes that the importer reads, each with another component type.
PlainMesh bumpy_square() {
  std::mt19937 random(5);
  const auto number = [&random](float low, float high) {
    return low + (high - low) * static_cast<float>(random() >> 8) / 16777216.0f;
  };
  std::vector<float> positions, normals, tangents, uv0;
  std::vector<std::uint16_t> uv1, colors;
  std::vector<std::uint8_t> joints, weights;
  for (std::uint32_t y = 0; y < kSide; ++y) {
    for (std::uint32_t x = 0; x < kSide; ++x) {
      positions.insert(positions.end(), {static_cast<float>(x), number(-0.3f, 0.3f), static_cast<float>(y)});
      const vec3 normal = glm::normalize(vec3(number(-0.5f, 0.5f), 1.0f, number(-0.5f, 0.5f)));
      normals.insert(normals.end(), {normal.x, normal.y, normal.z});
      const vec3 tangent = glm::normalize(glm::cross(normal, vec3(number(-1, 1), 0.2f, number(-1, 1))));
      tangents.insert(tangents.end(), {tangent.x, tangent.y, tangent.z, random() % 2 == 0 ? 1.0f : -1.0f});
      uv0.insert(uv0.end(), {number(0, 4), number(0, 4)});
      for (int i = 0; i < 2; ++i) uv1.push_back(static_cast<std::uint16_t>(random()));
      for (int i = 0; i < 4; ++i) colors.push_back(static_cast<std::uint16_t>(random()));
      for (int i = 0; i < 4; ++i) joints.push_back(static_cast<std::uint8_t>(random() % 2));
      for (int i = 0; i < 4; ++i) weights.push_back(static_cast<std::uint8_t>(1 + random() % 255));
    }
  }
  PlainMesh mesh;
  mesh.attributes = {
      plain_attribute("POSITION", 40, 5126, 3, positions),  plain_attribute("NORMAL", 3, 5126, 3, normals),
      plain_attribute("TANGENT", 0, 5126, 4, tangents),     plain_attribute("TEXCOORD_0", 7, 5126, 2, uv0),
      plain_attribute("TEXCOORD_1", 6, 5123, 2, uv1, true), plain_attribute("COLOR_0", 1, 5123, 4, colors, true),
      plain_attribute("JOINTS_0", 12, 5121, 4, joints),     plain_attribute("WEIGHTS_0", 1000, 5121, 4, weights, true)};
  for (std::uint32_t y = 0; y + 1 < kSide; ++y)
    for (std::uint32_t x = 0; x + 1 < kSide; ++x)
      for (const std::uint32_t corner : {0u, 1u, kSide, kSide, 1u, kSide + 1})
        mesh.indices.push_back(y * kSide + x + corner);
  return mesh;
}

std::string type_of(int components) { return components == 1 ? "SCALAR" : "VEC" + std::to_string(components); }

/// Members of an accessor that tell its form.
std::string form_of(const PlainAttribute& attribute) {
  return R"("componentType": )" + std::to_string(attribute.component_type) + R"(, "count": )" +
         std::to_string(attribute.count()) + R"(, "type": ")" + type_of(attribute.components) + "\"" +
         (attribute.normalized ? R"(, "normalized": true)" : "");
}

/// A file with one primitive, to which tests do harm. The primitive is compressed if it has a stream.
struct MeshFile {
  explicit MeshFile(const PlainMesh& plain) : mesh(plain) {
    for (const PlainAttribute& attribute : mesh.attributes) forms.push_back(form_of(attribute));
    index_count = mesh.indices.size();
  }
  MeshFile(const PlainMesh& plain, const DracoSettings& settings) : MeshFile(plain) {
    stream = test::encode_draco(mesh.attributes, mesh.indices, settings);
  }

  [[nodiscard]] std::string text() const {
    GltfText gltf;
    gltf.add("images", R"({"uri": "data:image/png;base64,)" + test::base64(test::make_png(1, 1, kGrey)) + "\"}");
    gltf.add("textures", R"({"source": 0})");
    gltf.add("materials", R"({"normalTexture": {"index": 0}})");
    std::string attributes, ids;
    for (std::size_t i = 0; i < mesh.attributes.size(); ++i) {
      const PlainAttribute& attribute = mesh.attributes[i];
      std::string view;
      if (stream.empty() || with_fallback)
        view = R"("bufferView": )" + std::to_string(gltf.view_of(attribute.bytes)) + ", ";
      const int accessor = gltf.add("accessors", "{" + view + forms[i] + "}");
      attributes += (i == 0 ? "\"" : ", \"") + attribute.name + "\": " + std::to_string(accessor);
      const std::uint32_t id = i == 0 && first_id >= 0 ? static_cast<std::uint32_t>(first_id) : attribute.draco_id;
      ids += (i == 0 ? "\"" : ", \"") + attribute.name + "\": " + std::to_string(id);
    }
    std::string view;
    if (stream.empty() || with_fallback) view = R"("bufferView": )" + std::to_string(gltf.view_of(mesh.indices)) + ", ";
    const int indices = gltf.add("accessors", "{" + view + R"("componentType": 5125, "type": "SCALAR", "count": )" +
                                                  std::to_string(index_count) + "}");
    std::string more =
        R"(, "material": 0, "indices": )" + std::to_string(indices) + ", \"mode\": " + std::to_string(mode);
    if (!stream.empty()) {
      more += R"(, "extensions": {"KHR_draco_mesh_compression": {"bufferView": )" +
              std::to_string(gltf.view_of(stream)) + R"(, "attributes": {)" + ids + "}}}";
      gltf.set("extensionsUsed", R"(["KHR_draco_mesh_compression"])");
      if (!with_fallback) gltf.set("extensionsRequired", R"(["KHR_draco_mesh_compression"])");
    }
    gltf.mesh(attributes, more);
    gltf.add("skins", R"({"joints": [1, 2]})");
    gltf.add("nodes", R"({"mesh": 0, "skin": 0})");
    gltf.add("nodes", "{}");
    gltf.add("nodes", "{}");
    gltf.add("scenes", R"({"nodes": [0, 1, 2]})");
    return gltf.text();
  }

  PlainMesh mesh;
  std::vector<std::string> forms;
  std::size_t index_count = 0;
  Bytes stream;
  bool with_fallback = false;
  int first_id = -1;
  int mode = 4;
};

std::string fault_of(const MeshFile& file) {
  Import import;
  test::import_text(file.text(), import);
  return import.fault();
}

Primitive imported(const MeshFile& file) {
  Import import;
  test::import_text(file.text(), import);
  EXPECT_EQ(import.fault(), "");
  EXPECT_THAT(import.log, ::testing::IsEmpty());
  if (!import.ok()) return {};
  const Mesh& mesh = import.world.resource<SceneAssets>().meshes[0];
  EXPECT_EQ(mesh.primitives.size(), 1u);
  return mesh.primitives.empty() ? Primitive{} : mesh.primitives[0];
}

/// All attributes of a vertex. The position is last, so that vertices are sorted by the others.
std::vector<float> vertex_of(const Primitive& primitive, std::size_t i) {
  std::vector<float> values;
  const auto add = [&](const auto& list) {
    for (int c = 0; c < list[i].length(); ++c) values.push_back(list[i][c]);
  };
  add(primitive.normals);
  add(primitive.tangents);
  add(primitive.uv0);
  add(primitive.uv1);
  add(primitive.colors);
  add(primitive.weights);
  for (const std::uint16_t joint : primitive.joints[i]) values.push_back(joint);
  add(primitive.positions);
  return values;
}

using Triangle = std::vector<std::vector<float>>;

/// The triangles, in an order that does not depend on that of the vertices. Corners keep their turn.
std::vector<Triangle> triangles_of(const Primitive& primitive) {
  std::vector<Triangle> triangles;
  for (std::size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
    Triangle triangle;
    for (std::size_t k = 0; k < 3; ++k) triangle.push_back(vertex_of(primitive, primitive.indices[i + k]));
    std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()), triangle.end());
    triangles.push_back(std::move(triangle));
  }
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

// Hard case: scene.draco
TEST(CompressedMeshes, all_attributes_of_all_types_come_back_exactly) {
  const PlainMesh mesh = bumpy_square();
  const std::vector<Triangle> wanted = triangles_of(imported(MeshFile(mesh)));
  ASSERT_EQ(wanted.size(), std::size_t{(kSide - 1) * (kSide - 1) * 2});
  for (const bool edgebreaker : {true, false})
    for (const bool with_metadata : {true, false}) {
      const MeshFile file(mesh, {.edgebreaker = edgebreaker, .with_metadata = with_metadata});
      EXPECT_TRUE(triangles_of(imported(file)) == wanted) << "edgebreaker " << edgebreaker;
    }
}

TEST(CompressedMeshes, quantised_positions_keep_to_half_a_step) {
  const PlainMesh mesh = bumpy_square();
  const std::vector<Triangle> wanted = triangles_of(imported(MeshFile(mesh)));
  for (const int bits : {8, 11, 14}) {
    const std::vector<Triangle> found = triangles_of(imported(MeshFile(mesh, {.position_bits = bits})));
    ASSERT_EQ(found.size(), wanted.size());
    const float half_step = 0.5f * static_cast<float>(kSide - 1) / static_cast<float>((1 << bits) - 1);
    float worst = 0.0f;
    for (std::size_t t = 0; t < wanted.size(); ++t) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t others = wanted[t][k].size() - 3;
        for (std::size_t c = others; c < others + 3; ++c)
          worst = std::max(worst, std::abs(found[t][k][c] - wanted[t][k][c]));
        for (std::size_t c = 0; c < others; ++c) ASSERT_EQ(found[t][k][c], wanted[t][k][c]);
      }
    }
    EXPECT_LE(worst, half_step * 1.001f) << bits;
    EXPECT_GT(worst, half_step * 0.2f) << bits;  // it was quantised
  }
}

TEST(CompressedMeshes, the_compressed_data_counts_where_a_file_has_both) {
  PlainMesh mesh = bumpy_square();
  MeshFile file(mesh, {});
  const std::vector<Triangle> wanted = triangles_of(imported(MeshFile(mesh)));
  file.with_fallback = true;
  EXPECT_TRUE(triangles_of(imported(file)) == wanted);
  for (PlainAttribute& attribute : file.mesh.attributes)  // another mesh in the fallback
    std::reverse(attribute.bytes.begin(), attribute.bytes.end());
  EXPECT_TRUE(triangles_of(imported(file)) == wanted);
}

TEST(CompressedMeshes, the_triangles_are_a_list_also_where_the_primitive_is_a_strip) {
  const PlainMesh mesh = bumpy_square();
  MeshFile file(mesh, {});
  file.mode = 5;
  EXPECT_TRUE(triangles_of(imported(file)) == triangles_of(imported(MeshFile(mesh))));
  file.mode = 0;
  EXPECT_THAT(fault_of(file), HasSubstr("mode must be 4 or 5, is 0"));
}

TEST(CompressedMeshes, primitives_that_share_accessors_have_their_own_content) {
  GltfText gltf;
  const std::vector<float> low = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  const std::vector<float> high = {0, 0, 5, 1, 0, 5, 0, 1, 5};
  const std::vector<std::uint32_t> indices = {0, 1, 2};
  gltf.add("accessors", R"({"componentType": 5126, "count": 3, "type": "VEC3"})");
  gltf.add("accessors", R"({"componentType": 5123, "count": 3, "type": "SCALAR"})");
  for (const std::vector<float>& positions : {low, high}) {
    const PlainAttribute attributes[] = {plain_attribute("POSITION", 0, 5126, 3, positions)};
    gltf.mesh(R"("POSITION": 0)", R"(, "indices": 1, "extensions": {"KHR_draco_mesh_compression": {"bufferView": )" +
                                      std::to_string(gltf.view_of(test::encode_draco(attributes, indices))) +
                                      R"(, "attributes": {"POSITION": 0}}})");
  }
  gltf.add("nodes", R"({"mesh": 0})");
  Import import;
  test::import_text(gltf.text(), import);
  ASSERT_EQ(import.fault(), "");
  const std::vector<Mesh>& meshes = import.world.resource<SceneAssets>().meshes;
  EXPECT_EQ(meshes[0].bounds.max, vec3(1, 1, 0));
  EXPECT_EQ(meshes[1].bounds.max, vec3(1, 1, 5));
}

const std::string kPlace = "scene.gltf: mesh 0, primitive 0, KHR_draco_mesh_compression: ";

// Hard case: scene.lying_draco
TEST(CompressedMeshes, a_stream_that_does_not_hold_what_the_accessors_say_is_refused) {
  const PlainMesh mesh = bumpy_square();
  const MeshFile sound(mesh, {});
  MeshFile file = sound;
  file.index_count = 381;
  EXPECT_EQ(fault_of(file), kPlace + "it holds 128 triangles, but its indices (accessor 8) have 381 elements");
  file = sound;
  file.first_id = 5;
  EXPECT_EQ(fault_of(file), kPlace + "POSITION is attribute 5 of the compressed mesh, which has none of this id");
  file.first_id = 6;
  EXPECT_EQ(fault_of(file),
            kPlace + "POSITION (accessor 0) has 3 components, but attribute 6 of the compressed mesh has 2");
  for (const std::string count : {"80", "82", "4000000000"}) {
    file = sound;
    for (std::string& form : file.forms) form.replace(form.find("\"count\": 81"), 11, "\"count\": " + count);
    EXPECT_EQ(fault_of(file), kPlace + "it holds 81 vertices, but COLOR_0 (accessor 5) has " + count + " elements");
  }
  file = sound;
  file.forms[1].replace(file.forms[1].find("\"count\": 81"), 11, "\"count\": 27");
  EXPECT_EQ(fault_of(file), kPlace + "it holds 81 vertices, but NORMAL (accessor 1) has 27 elements");
  file = sound;
  file.forms[5].replace(file.forms[5].find("5123"), 4, "5121");  // 16-bit colours do not fit
  EXPECT_EQ(fault_of(file), kPlace + "a value of COLOR_0 (accessor 5) does not fit componentType 5121");
  file = sound;
  file.stream = test::encode_draco_points(mesh.attributes);
  EXPECT_EQ(fault_of(file), kPlace + "it holds points, not triangles");
}

// Hard case: scene.damaged_draco
TEST(CompressedMeshes, a_stream_cut_anywhere_is_refused_and_one_with_changed_bytes_loads_or_is_refused) {
  const PlainMesh mesh = bumpy_square();
  std::mt19937 random(11);
  for (const bool edgebreaker : {true, false}) {
    const MeshFile sound(mesh, {.edgebreaker = edgebreaker, .position_bits = 11});
    for (std::size_t size = 1; size < sound.stream.size(); size += size < 64 ? 1 : 61) {
      MeshFile file = sound;
      file.stream.resize(size);
      EXPECT_THAT(fault_of(file), ::testing::StartsWith(kPlace)) << size;
    }
    for (int i = 0; i < test::scaled(300); ++i) {
      MeshFile file = sound;
      for (int k = 0; k < 3; ++k)
        file.stream[random() % (i % 2 == 0 ? 40 : file.stream.size())] = static_cast<std::uint8_t>(random());
      const std::string fault = fault_of(file);
      if (!fault.empty()) {
        EXPECT_THAT(fault, ::testing::StartsWith("scene.gltf: ")) << i;
      }
    }
  }
}

void put_varint(Bytes& bytes, std::uint64_t value) {
  for (; value >= 128; value >>= 7) bytes.push_back(static_cast<std::uint8_t>(value | 128));
  bytes.push_back(static_cast<std::uint8_t>(value));
}

/// A short stream whose header states these counts.
Bytes stream_of_counts(std::uint8_t method, std::uint64_t first, std::uint64_t second) {
  Bytes stream = {'D', 'R', 'A', 'C', 'O', 2, 2, 1, method, 0, 0};
  if (method == 1) stream.push_back(0);  // traversal of edgebreaker
  put_varint(stream, first);
  put_varint(stream, second);
  stream.resize(stream.size() + 64);
  return stream;
}

TEST(CompressedMeshes, gigantic_counts_are_refused_before_any_memory_is_taken) {
  const PlainMesh mesh = bumpy_square();
  MeshFile file(mesh, {});
  const std::string too_much = "take more memory than the files justify";
  for (const std::uint64_t faces : {std::uint64_t{500000000}, std::uint64_t{1431655765}}) {
    file.index_count = faces * 3;
    file.stream = stream_of_counts(0, faces, 81);  // faces, points
    EXPECT_THAT(fault_of(file), HasSubstr(too_much)) << faces;
    file.stream = stream_of_counts(1, 81, faces);  // vertices, faces
    EXPECT_THAT(fault_of(file), HasSubstr(too_much)) << faces;
  }
  file.index_count = 381;
  file.stream = stream_of_counts(0, 127, 400000000);
  EXPECT_EQ(fault_of(file), kPlace + "it holds 400000000 vertices, but COLOR_0 (accessor 5) has 81 elements");
}

TEST(CompressedMeshes, attributes_that_nobody_reads_are_counted_as_memory_too) {
  // All indices are 0, and 200 attributes have 255 doubles per vertex: 122 GB.
  constexpr std::uint32_t kVertices = 300000;
  Bytes stream = {'D', 'R', 'A', 'C', 'O', 2, 2, 1, 0, 0, 0};
  put_varint(stream, kVertices / 3);
  put_varint(stream, kVertices);
  stream.push_back(1);  // indices that are not compressed, as varints
  stream.resize(stream.size() + kVertices);
  stream.push_back(1);  // one decoder of attributes
  put_varint(stream, 200);
  for (std::uint32_t id = 0; id < 200; ++id) {
    stream.insert(stream.end(), {4, 10, 255, 0});  // generic, doubles, components, not normalised
    put_varint(stream, id);
  }
  stream.resize(stream.size() + 264);  // the method of each attribute, and some values
  PlainMesh mesh;
  mesh.attributes = {plain_attribute("POSITION", 0, 5126, 3, std::vector<float>(kVertices * 3))};
  mesh.indices.resize(kVertices);
  MeshFile file(mesh);
  file.stream = stream;
  EXPECT_EQ(fault_of(file), kPlace + "its vertices take more memory than the files justify");
}

TEST(CompressedMeshes, the_extension_is_checked_as_all_members_are) {
  const auto fault = [](const std::string& extension) {
    GltfText gltf;
    const int positions = gltf.floats({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3");
    gltf.mesh("\"POSITION\": " + std::to_string(positions),
              R"(, "extensions": {"KHR_draco_mesh_compression": )" + extension + "}");
    Import import;
    test::import_text(gltf.text(), import);
    return import.fault();
  };
  EXPECT_THAT(fault("{}"), HasSubstr("bufferView is missing"));
  EXPECT_THAT(fault("3"), HasSubstr("KHR_draco_mesh_compression must be an object"));
  EXPECT_THAT(fault(R"({"bufferView": 9, "attributes": {}})"), HasSubstr("bufferView is 9, but the file has 1"));
  EXPECT_THAT(fault(R"({"bufferView": 0, "attributes": {"POSITION": -1}})"), HasSubstr("must be an integer in 0"));
  EXPECT_THAT(fault(R"({"bufferView": 0, "attributes": {}})"), HasSubstr("it names no attribute"));
  EXPECT_THAT(fault(R"({"bufferView": 0, "attributes": {"POSITION": 0}})"), HasSubstr("it is damaged"));
}

}  // namespace
}  // namespace gloam

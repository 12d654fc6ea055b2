// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "tests/fuzz/scene_seeds.h"

#include <meshoptimizer.h>

#include <string>

#include "tests/support/draco_files.h"
#include "tests/support/gltf_files.h"
#include "tests/support/webp_files.h"

namespace gloam::fuzz {
namespace {

using test::GltfText;

constexpr std::uint8_t kRed[4] = {255, 0, 0, 255};

std::string text_of(int number) { return std::to_string(number); }

/// A skinned and morphed mesh with a material, images, a camera, an animation and a light.
GltfText character() {
  GltfText gltf;
  const std::string positions = text_of(gltf.floats({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3"));
  const std::string uv = text_of(gltf.floats({0, 1, 1, 1, 0, 0}, "VEC2"));
  const std::string joints = text_of(gltf.accessor(std::vector<std::uint8_t>(12, 0), 5121, "VEC4"));
  const std::string weights = text_of(gltf.floats(std::vector<float>(12, 0.25f), "VEC4"));
  const std::string indices = text_of(gltf.accessor(std::vector<std::uint16_t>{0, 1, 2}, 5123, "SCALAR"));
  const std::string times = text_of(gltf.floats({0, 1}, "SCALAR"));
  const std::string moves = text_of(gltf.floats({0, 0, 0, 1, 1, 1}, "VEC3"));
  const std::string morphs = text_of(gltf.floats({0, 1, 0, 0, 1, 0}, "SCALAR"));
  std::vector<float> identities(32);
  for (std::size_t i = 0; i < 8; ++i) identities[16 * (i / 4) + 5 * (i % 4)] = 1.0f;
  const std::string bind = text_of(gltf.floats(identities, "MAT4"));
  gltf.mesh("\"POSITION\": " + positions + ", \"TEXCOORD_0\": " + uv + ", \"JOINTS_0\": " + joints +
                ", \"WEIGHTS_0\": " + weights,
            ", \"material\": 0, \"indices\": " + indices + ", \"targets\": [{\"POSITION\": " + positions + "}]");
  for (const auto& file : {test::make_png(2, 2, kRed), test::make_jpeg(9, 8, kRed)})
    gltf.add("images", R"({"mimeType": "image/png", "bufferView": )" + text_of(gltf.view_of(file)) + "}");
  gltf.add("samplers", R"({"wrapS": 33071, "magFilter": 9728})");
  gltf.add("textures", R"({"source": 0, "sampler": 0})");
  gltf.add("textures", R"({"source": 1})");
  gltf.add("materials", R"({"normalTexture": {"index": 0}, "emissiveFactor": [1, 0.5, 0], "alphaMode": "MASK",
      "pbrMetallicRoughness": {"baseColorTexture": {"index": 1, "extensions": {"KHR_texture_transform":
      {"offset": [0.5, 0], "rotation": 1, "scale": [2, 2]}}}}, "extensions": {"KHR_materials_emissive_strength":
      {"emissiveStrength": 9}, "KHR_materials_transmission": {"transmissionFactor": 0.5}},
      "extras": {"gloam.subsurface": true, "gloam.reflectivity": 0.5}})");
  gltf.add("cameras", R"({"type": "perspective", "perspective": {"yfov": 0.5, "znear": 0.1, "zfar": 10}})");
  gltf.add("nodes", R"({"name": "root", "mesh": 0, "skin": 0, "children": [1, 2], "weights": [0.5],
      "extras": {"gloam.closeup": true, "gloam.closeup.lights": "lamp", "gloam.shadow.cast": true}})");
  gltf.add("nodes", R"({"name": "camera", "camera": 0, "rotation": [0, 0, 0, 1], "scale": [1, 2, 3],
      "extras": {"gloam.dof.focus": 2, "gloam.dof.f_number": 1.4}})");
  gltf.add("nodes", R"({"name": "lamp", "matrix": [1,0,0,0, 0,1,0,0, 0,0,1,0, 5,6,7,1],
      "extras": {"gloam.light.width": 0.5}, "extensions": {"KHR_lights_punctual": {"light": 0}}})");
  gltf.set("extensions", R"({"KHR_lights_punctual": {"lights": [{"type": "spot", "color": [1, 1, 0.5],
      "intensity": 100, "range": 20, "spot": {"innerConeAngle": 0.1, "outerConeAngle": 0.5}}]}})");
  gltf.add("skins", R"({"joints": [1, 2], "inverseBindMatrices": )" + bind + "}");
  gltf.add("animations", R"({"samplers": [{"input": )" + times + R"(, "output": )" + moves + R"(}, {"input": )" +
                             times + R"(, "interpolation": "CUBICSPLINE", "output": )" + morphs +
                             R"(}], "channels": [{"sampler": 0, "target": {"node": 1, "path": "translation"}},
                             {"sampler": 1, "target": {"node": 0, "path": "weights"}}]})");
  gltf.add("scenes", R"({"nodes": [0], "extras": {"gloam.exposure": 1, "gloam.sky.zenith": [1, 2, 3]}})");
  return gltf;
}

/// Keys of all modules on nodes, instances of a mesh, and sparse and interleaved accessors.
GltfText landscape() {
  GltfText gltf;
  const std::string indices = text_of(gltf.view_of(std::vector<std::uint16_t>{1, 2}));
  const std::string values = text_of(gltf.view_of(std::vector<float>{1, 0, 0, 0, 1, 0}));
  const std::string sparse = text_of(
      gltf.add("accessors", R"({"componentType": 5126, "count": 3, "type": "VEC3", "sparse": {"count": 2, )"
                            R"("indices": {"bufferView": )" +
                                indices + R"(, "componentType": 5123}, "values": {"bufferView": )" + values + "}}}"));
  const std::vector<float> interleaved = {0, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 1, 0, 0, 0, 1, 1, 1, 0, 0, 0, 1};
  const std::string view = text_of(gltf.view(std::as_bytes(std::span(interleaved)), R"(, "byteStride": 24)"));
  const std::string of_view = R"({"bufferView": )" + view + R"(, "componentType": 5126, "count": 4, "type": "VEC3")";
  const std::string positions = text_of(gltf.add("accessors", of_view + "}"));
  const std::string normals = text_of(gltf.add("accessors", of_view + R"(, "byteOffset": 12})"));
  const std::string colors =
      text_of(gltf.accessor(std::vector<std::uint8_t>(16, 200), 5121, "VEC4", R"(, "normalized": true)"));
  gltf.mesh("\"POSITION\": " + sparse);
  gltf.mesh("\"POSITION\": " + positions + ", \"NORMAL\": " + normals + ", \"COLOR_0\": " + colors, R"(, "mode": 5)");
  const std::string translations = text_of(gltf.floats({1, 0, 0, 0, 2, 0, 0, 0, 3}, "VEC3"));
  const std::string rotations = text_of(gltf.accessor(
      std::vector<std::int8_t>{0, 0, 0, 127, 0, 127, 0, 0, 127, 0, 0, 0}, 5120, "VEC4", R"(, "normalized": true)"));
  gltf.add("nodes", R"({"mesh": 0, "extensions": {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": )" +
                        translations + ", \"ROTATION\": " + rotations + "}}}}");
  gltf.add("nodes", R"({"mesh": 1, "extras": {"gloam.grass.density": 5, "gloam.grass.height": [0.3, 0.05],
      "gloam.collider": "capsule", "gloam.collider.radius": 1, "gloam.collider.height": 3}})");
  gltf.add("nodes", R"({"extras": {"gloam.particles": "smoke", "gloam.particles.rate": 10, "gloam.particles.box":
      [1, 1, 1], "gloam.wind.velocity": [1, 0, 0], "gloam.fog.density": 0.01}})");
  gltf.add("nodes", R"({"extras": {"gloam.ibr_proxy.size": [1, 2], "gloam.ibr_proxy.kind": "scene"}})");
  gltf.add("nodes", R"({"extras": {"gloam.ibr_room.size": [9, 9, 9]}})");
  gltf.add("nodes", R"({"extras": {"gloam.cube_probe.size": [9, 9, 9], "gloam.cube_probe.resolution": 32}})");
  gltf.add("scenes", R"({"nodes": [0, 1, 2]})");
  gltf.add("scenes", R"({"name": "rest", "nodes": [3, 4, 5]})");
  gltf.set("scene", "1");
  return gltf;
}

/// A compressed mesh (EXT_meshopt_compression) with a fallback buffer.
GltfText compressed() {
  GltfText gltf;
  const std::vector<std::int16_t> positions = {0, 0, 0, 0, 100, 0, 0, 0, 0, 100, 0, 0, 100, 100, 0, 0};
  Bytes vertices(meshopt_encodeVertexBufferBound(4, 8));
  vertices.resize(meshopt_encodeVertexBuffer(vertices.data(), vertices.size(), positions.data(), 4, 8));
  const std::vector<unsigned> corners = {0, 1, 2, 2, 1, 3};
  Bytes triangles(meshopt_encodeIndexBufferBound(6, 4));
  triangles.resize(meshopt_encodeIndexBuffer(triangles.data(), triangles.size(), corners.data(), 6));
  Bytes bytes = vertices;
  bytes.insert(bytes.end(), triangles.begin(), triangles.end());
  gltf.add("buffers", R"({"byteLength": )" + std::to_string(bytes.size()) +
                          R"(, "uri": "data:application/octet-stream;base64,)" + test::base64(bytes) + "\"}");
  gltf.add("buffers", R"({"byteLength": 44, "extensions": {"EXT_meshopt_compression": {"fallback": true}}})");
  gltf.add("bufferViews", R"({"buffer": 1, "byteLength": 32, "byteStride": 8, "extensions": {"EXT_meshopt_compression":
      {"buffer": 0, "byteLength": )" +
                              std::to_string(vertices.size()) +
                              R"(, "byteStride": 8, "count": 4, "mode": "ATTRIBUTES", "filter": "NONE"}}})");
  gltf.add("bufferViews", R"({"buffer": 1, "byteOffset": 32, "byteLength": 12, "extensions": {"EXT_meshopt_compression":
      {"buffer": 0, "byteOffset": )" +
                              std::to_string(vertices.size()) + R"(, "byteLength": )" +
                              std::to_string(triangles.size()) +
                              R"(, "byteStride": 2, "count": 6, "mode": "TRIANGLES"}}})");
  gltf.add("accessors", R"({"bufferView": 0, "componentType": 5122, "type": "VEC3", "count": 4})");
  gltf.add("accessors", R"({"bufferView": 1, "componentType": 5123, "type": "SCALAR", "count": 6})");
  gltf.mesh(R"("POSITION": 0)", R"(, "indices": 1)");
  gltf.add("nodes", R"({"mesh": 0})");
  return gltf;
}

/// Two squares of KHR_draco_mesh_compression, one for each of its methods, and pictures of EXT_texture_webp.
GltfText draco_and_webp() {
  GltfText gltf;
  const std::vector<float> positions = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 2, 0, 1, 2, 1, 1};
  const std::vector<float> normals = {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0};
  const std::vector<std::uint16_t> uv = {0, 0, 65535, 0, 0, 65535, 65535, 65535, 0, 0, 65535, 0};
  const test::PlainAttribute attributes[] = {test::plain_attribute("POSITION", 2, 5126, 3, positions),
                                             test::plain_attribute("NORMAL", 0, 5126, 3, normals),
                                             test::plain_attribute("TEXCOORD_0", 1, 5123, 2, uv, true)};
  const std::uint32_t indices[] = {0, 1, 2, 2, 1, 3, 1, 4, 3, 3, 4, 5};
  for (const test::DracoSettings& settings :
       {test::DracoSettings{.position_bits = 11}, test::DracoSettings{.edgebreaker = false, .with_metadata = true}}) {
    const std::string accessor =
        text_of(gltf.add("accessors", R"({"componentType": 5126, "count": 6, "type": "VEC3"})"));
    const std::string uvs =
        text_of(gltf.add("accessors", R"({"componentType": 5123, "normalized": true, "count": 6, "type": "VEC2"})"));
    const std::string list =
        text_of(gltf.add("accessors", R"({"componentType": 5123, "count": 12, "type": "SCALAR"})"));
    const std::string view = text_of(gltf.view_of(test::encode_draco(attributes, indices, settings)));
    gltf.mesh("\"POSITION\": " + accessor + ", \"NORMAL\": " + accessor + ", \"TEXCOORD_0\": " + uvs,
              R"(, "material": 0, "indices": )" + list +
                  R"(, "extensions": {"KHR_draco_mesh_compression": {"bufferView": )" + view +
                  R"(, "attributes": {"POSITION": 2, "NORMAL": 0, "TEXCOORD_0": 1}}})");
  }
  Bytes pixels(9 * 7 * 4);
  for (std::size_t i = 0; i < pixels.size(); ++i) pixels[i] = static_cast<std::uint8_t>(i * i / 3);
  for (const float quality : {-1.0f, 70.0f}) {
    const std::string view = text_of(gltf.view_of(test::encode_webp(9, 7, pixels, quality)));
    const int image = gltf.add("images", R"({"mimeType": "image/webp", "bufferView": )" + view + "}");
    gltf.add("textures", R"({"extensions": {"EXT_texture_webp": {"source": )" + text_of(image) + "}}}");
  }
  gltf.add("materials", R"({"emissiveTexture": {"index": 0}, "normalTexture": {"index": 1},
      "extensions": {"KHR_materials_clearcoat": {"clearcoatFactor": 1}, "KHR_materials_ior": {"ior": 1.33}}})");
  gltf.add("nodes", R"({"mesh": 0})");
  gltf.add("nodes", R"({"mesh": 1})");
  return gltf;
}

}  // namespace

std::vector<Bytes> scene_seeds() {
  return {bytes_of(character().text()),  character().glb(),
          bytes_of(landscape().text()),  landscape().glb(),
          bytes_of(compressed().text()), bytes_of(draco_and_webp().text()),
          draco_and_webp().glb()};
}

}  // namespace gloam::fuzz

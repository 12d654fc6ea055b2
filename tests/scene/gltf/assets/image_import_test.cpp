// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/scene/gltf/assets/image_import.h"

#include <gmock/gmock.h>

#include <cmath>

#include "engine/jobs/executor.h"
#include "engine/scene/assets.h"
#include "tests/support/gltf_files.h"

namespace gloam {
namespace {

using test::GltfText;
using test::Import;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr std::uint8_t kRed[4] = {255, 0, 0, 255};
constexpr std::uint8_t kBlue[4] = {0, 0, 255, 255};

std::string data_uri(const std::string& mime, const std::vector<std::uint8_t>& bytes) {
  return R"({"uri": "data:)" + mime + ";base64," + test::base64(bytes) + "\"}";
}

const SceneAssets& assets_of(GltfText gltf, Import& import) {
  gltf.add("nodes", "{}");
  test::import_text(gltf.text(), import);
  EXPECT_EQ(import.fault(), "");
  return import.world.resource<SceneAssets>();
}

TEST(MaterialImport, an_empty_material_has_the_defaults_of_gltf) {
  GltfText gltf;
  gltf.add("materials", "{}");
  Import import;
  const SceneAssets& assets = assets_of(gltf, import);
  ASSERT_EQ(assets.materials.size(), 1u);
  const Material& material = assets.materials[0];
  EXPECT_EQ(material.base_color, vec4(1.0f));
  EXPECT_EQ(material.emissive, vec3(0.0f));
  EXPECT_EQ(material.metallic, 1.0f);
  EXPECT_EQ(material.roughness, 1.0f);
  EXPECT_EQ(material.alpha_mode, AlphaMode::opaque);
  EXPECT_EQ(material.alpha_cutoff, 0.5f);
  EXPECT_FALSE(material.double_sided);
  EXPECT_EQ(material.base_color_texture.texture, kNone);
  EXPECT_FALSE(material.subsurface);
  EXPECT_LT(material.reflectivity, 0.0f);
}

TEST(MaterialImport, factors_modes_and_emissive_strength_are_read) {
  GltfText gltf;
  gltf.set("extensionsUsed", R"(["KHR_materials_emissive_strength"])");
  gltf.add("materials", R"({"name": "lamp", "alphaMode": "MASK", "alphaCutoff": 0.25, "doubleSided": true,
      "emissiveFactor": [1, 0.5, 0], "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 20}},
      "pbrMetallicRoughness": {"baseColorFactor": [0.1, 0.2, 0.3, 0.4], "metallicFactor": 0, "roughnessFactor": 0.5}})");
  gltf.add("materials", R"({"alphaMode": "BLEND"})");
  Import import;
  const SceneAssets& assets = assets_of(gltf, import);
  ASSERT_EQ(assets.materials.size(), 2u);
  const Material& material = assets.materials[0];
  EXPECT_EQ(material.name, "lamp");
  EXPECT_EQ(material.base_color, vec4(0.1f, 0.2f, 0.3f, 0.4f));
  EXPECT_EQ(material.emissive, vec3(20, 10, 0));
  EXPECT_EQ(material.metallic, 0.0f);
  EXPECT_EQ(material.roughness, 0.5f);
  EXPECT_EQ(material.alpha_mode, AlphaMode::mask);
  EXPECT_EQ(material.alpha_cutoff, 0.25f);
  EXPECT_TRUE(material.double_sided);
  EXPECT_EQ(assets.materials[1].alpha_mode, AlphaMode::blend);
  EXPECT_THAT(import.info().warnings, IsEmpty());
}

TEST(MaterialImport, a_texture_transform_is_a_matrix_and_may_change_the_set) {
  GltfText gltf;
  gltf.add("images", data_uri("image/png", test::make_png(1, 1, kRed)));
  gltf.add("textures", R"({"source": 0})");
  gltf.add("materials", R"({"normalTexture": {"index": 0, "scale": 2, "texCoord": 0, "extensions": {
      "KHR_texture_transform": {"offset": [0.25, 0.5], "rotation": 1.5707963267948966, "scale": [2, 3], "texCoord": 1}}}})");
  Import import;
  const SceneAssets& assets = assets_of(gltf, import);
  ASSERT_EQ(assets.materials.size(), 1u);
  const TextureSlot& slot = assets.materials[0].normal_texture;
  EXPECT_EQ(slot.uv_set, 1u);
  EXPECT_EQ(assets.materials[0].normal_scale, 2.0f);
  // uv (1, 0) goes to offset + R · (2, 0) = (0.25, 0.5 − 2); uv (0, 1) to offset + R · (0, 3) = (0.25 + 3, 0.5).
  const auto transformed = [&](vec3 uv) {
    return vec2(glm::dot(slot.transform_row0, uv), glm::dot(slot.transform_row1, uv));
  };
  EXPECT_NEAR(glm::distance(transformed(vec3(1, 0, 1)), vec2(0.25f, -1.5f)), 0.0f, 1e-6f);
  EXPECT_NEAR(glm::distance(transformed(vec3(0, 1, 1)), vec2(3.25f, 0.5f)), 0.0f, 1e-6f);
}

TEST(MaterialImport, transmission_is_thin_glass_blended_by_what_it_reflects) {
  GltfText gltf;
  gltf.set("extensionsRequired", R"(["KHR_materials_transmission"])");
  const auto glass = [](const std::string& factor, const std::string& more) {
    return R"({"extensions": {"KHR_materials_transmission": {"transmissionFactor": )" + factor + "}}" + more + "}";
  };
  gltf.add("materials", glass("1", R"(, "pbrMetallicRoughness": {"baseColorFactor": [1, 1, 1, 0.25]})"));
  gltf.add("materials",
           glass("0.5", R"(, "alphaMode": "BLEND", "pbrMetallicRoughness": {"baseColorFactor": [1, 1, 1, 0.5]})"));
  gltf.add("materials", glass("0", ""));
  Import import;
  const SceneAssets& assets = assets_of(gltf, import);
  ASSERT_EQ(assets.materials.size(), 3u);
  EXPECT_EQ(assets.materials[0].alpha_mode, AlphaMode::blend);  // blended surfaces cast no shadows
  EXPECT_NEAR(assets.materials[0].base_color.w, 0.08f, 1e-6f);  // an opaque material has no alpha
  EXPECT_NEAR(assets.materials[1].base_color.w, 0.27f, 1e-6f);
  EXPECT_EQ(assets.materials[2].alpha_mode, AlphaMode::opaque);
}

TEST(MaterialImport, an_unlit_material_emits_its_base_colour) {
  GltfText gltf;
  gltf.set("extensionsRequired", R"(["KHR_materials_unlit"])");
  gltf.add("images", data_uri("image/png", test::make_png(1, 1, kRed)));
  gltf.add("textures", R"({"source": 0})");
  gltf.add("materials",
           R"({"extensions": {"KHR_materials_unlit": {}, "KHR_materials_emissive_strength": {"emissiveStrength": 4}},
      "pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.25, 1, 0.5], "baseColorTexture": {"index": 0}}})");
  Import import;
  const SceneAssets& assets = assets_of(gltf, import);
  ASSERT_EQ(assets.materials.size(), 1u);
  const Material& material = assets.materials[0];
  EXPECT_EQ(material.emissive, vec3(2, 1, 4));
  EXPECT_EQ(material.emissive_texture.texture, 0u);
  EXPECT_EQ(material.base_color, vec4(0, 0, 0, 0.5f));
  EXPECT_EQ(material.reflectivity, 0.0f);
}

TEST(MaterialImport, a_reflective_material_with_a_texture_of_roughness_is_as_rough_as_the_texture) {
  GltfText gltf;
  gltf.add("images", data_uri("image/png", test::make_png(1, 1, kRed)));
  gltf.add("textures", R"({"source": 0})");
  gltf.add("materials", R"({"pbrMetallicRoughness": {"metallicRoughnessTexture": {"index": 0}},
      "extras": {"gloam.reflectivity": 0.9}})");
  Import import;
  const SceneAssets& assets = assets_of(gltf, import);
  ASSERT_EQ(assets.materials.size(), 1u);
  EXPECT_EQ(assets.materials[0].reflectivity, 0.9f);
  EXPECT_EQ(assets.materials[0].roughness, 1.0f);
}

TEST(TextureImport, a_texture_read_as_colour_and_as_data_becomes_two) {
  GltfText gltf;
  gltf.add("images", data_uri("image/png", test::make_png(1, 1, kRed)));
  gltf.add("samplers", R"({"magFilter": 9728, "wrapS": 33071, "wrapT": 33648})");
  gltf.add("textures", R"({"source": 0, "sampler": 0, "name": "both"})");
  gltf.add("materials", R"({"emissiveTexture": {"index": 0}, "occlusionTexture": {"index": 0},
      "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}})");
  Import import;
  const SceneAssets& assets = assets_of(gltf, import);
  ASSERT_EQ(assets.textures.size(), 2u);
  const Material& material = assets.materials[0];
  EXPECT_EQ(material.base_color_texture.texture, 0u);
  EXPECT_EQ(material.emissive_texture.texture, 0u);
  EXPECT_EQ(material.occlusion_texture.texture, 1u);
  EXPECT_TRUE(assets.textures[0].srgb);
  EXPECT_FALSE(assets.textures[1].srgb);
  for (const Texture& texture : assets.textures) {
    EXPECT_EQ(texture.image, 0u);
    EXPECT_TRUE(texture.nearest);
    EXPECT_EQ(texture.wrap_u, WrapMode::clamp_to_edge);
    EXPECT_EQ(texture.wrap_v, WrapMode::mirrored_repeat);
  }
}

TEST(TextureImport, a_texture_of_an_unknown_format_is_left_out_with_a_warning) {
  GltfText gltf;
  gltf.set("extensionsUsed", R"(["KHR_texture_basisu"])");
  gltf.add("textures", R"({"extensions": {"KHR_texture_basisu": {"source": 0}}})");
  gltf.add("materials", R"({"normalTexture": {"index": 0}})");
  Import import;
  const SceneAssets& assets = assets_of(gltf, import);
  EXPECT_EQ(assets.materials[0].normal_texture.texture, kNone);
  EXPECT_THAT(import.info().warnings, ElementsAre(HasSubstr("\"KHR_texture_basisu\" is not known, it is ignored"),
                                                  HasSubstr("texture 0: it has no PNG, JPEG or WebP image")));
}

TEST(TextureImport, a_third_set_of_coordinates_is_replaced_by_the_first_with_a_warning) {
  GltfText gltf;
  gltf.add("images", data_uri("image/png", test::make_png(1, 1, kRed)));
  gltf.add("textures", R"({"source": 0})");
  gltf.add("materials", R"({"name": "m", "emissiveTexture": {"index": 0, "texCoord": 2}})");
  Import import;
  EXPECT_EQ(assets_of(gltf, import).materials[0].emissive_texture.uv_set, 0u);
  EXPECT_THAT(import.info().warnings,
              ElementsAre(HasSubstr("material 0 \"m\": only texCoord 0 and 1 are read, not 2")));
}

TEST(ImageImport, images_come_from_text_from_the_buffer_and_from_files) {
  const test::TemporaryFolder folder;
  folder.write("textures/a b.png", test::make_png(3, 1, kBlue));
  GltfText gltf;
  gltf.add("images", data_uri("image/jpeg", test::make_jpeg(8, 8, kRed)));
  const auto png = test::make_png(2, 1, kRed);
  gltf.add("images", R"({"mimeType": "image/png", "name": "in the buffer", "bufferView": )" +
                         std::to_string(gltf.view_of(png)) + "}");
  gltf.add("images", R"({"uri": "textures/a%20b.png"})");
  Import import;
  const auto executor = make_shuffled_executor(3);
  import.result = import_gltf(folder.write("scene.gltf", gltf.text()), {}, test::light_registry(), import.world,
                              *executor, null_log());
  ASSERT_EQ(import.fault(), "");
  const auto& images = import.world.resource<SceneAssets>().images;
  ASSERT_EQ(images.size(), 3u);
  EXPECT_EQ(images[0].width, 8u);
  EXPECT_THAT(images[1].rgba, ElementsAre(255, 0, 0, 255, 255, 0, 0, 255));
  EXPECT_EQ(images[1].name, "in the buffer");
  EXPECT_EQ(images[2].width, 3u);
  EXPECT_THAT(std::vector<std::uint8_t>(images[2].rgba.begin(), images[2].rgba.begin() + 4),
              ElementsAre(0, 0, 255, 255));
}

TEST(ImageImport, bytes_that_several_images_name_are_decoded_once) {
  const test::TemporaryFolder folder;
  folder.write("a.png", test::make_png(1, 1, kBlue));
  GltfText gltf;
  const std::string view = std::to_string(gltf.view_of(test::make_png(2, 1, kRed)));
  for (const char* uri : {"a.png", "./a.png", "%61.png"}) gltf.add("images", R"({"uri": ")" + std::string(uri) + "\"}");
  for (int i = 0; i < 2; ++i) gltf.add("images", R"({"mimeType": "image/png", "bufferView": )" + view + "}");
  for (int i = 0; i < 5; ++i) gltf.add("textures", R"({"source": )" + std::to_string(i) + "}");
  Import import;
  test::import_file(folder.write("scene.gltf", gltf.text()), import);
  ASSERT_EQ(import.fault(), "");
  const SceneAssets& assets = import.world.resource<SceneAssets>();
  EXPECT_EQ(assets.images.size(), 2u);
  std::vector<std::uint32_t> images;
  for (const Texture& texture : assets.textures) images.push_back(texture.image);
  EXPECT_THAT(images, ElementsAre(0, 0, 0, 1, 1));
}

/// The header of a PNG of 16384×16384 pixels of one bit, and as many bytes as could hold them.
std::vector<std::uint8_t> png_bomb() {
  std::vector<std::uint8_t> png = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n', 0, 0, 0, 13, 'I', 'H', 'D',
                                   'R',  0,   0,   64,  0,    0,    0,    64,   0, 1, 0, 0,  0,   0};
  png.resize(33000);
  return png;
}

TEST(ImageImport, images_larger_than_their_files_justify_are_refused_before_any_is_decoded) {
  GltfText gltf;
  for (int i = 0; i < 3; ++i)
    gltf.add("images", R"({"mimeType": "image/png", "bufferView": )" + std::to_string(gltf.view_of(png_bomb())) + "}");
  Import import;
  test::import_text(gltf.text(), import);
  EXPECT_EQ(import.fault(),
            "scene.gltf: image 1: the scene's images up to here have 536870912 pixels, more than their 66000 bytes "
            "justify");
}

TEST(ImageImport, images_in_overlapping_ranges_of_a_buffer_are_refused) {
  GltfText gltf;
  const auto png = test::make_png(2, 1, kRed);
  gltf.view_of(png);
  const auto image = [&gltf](std::size_t offset, std::size_t length) {
    const int view = gltf.add("bufferViews", R"({"buffer": 0, "byteOffset": )" + std::to_string(offset) +
                                                 R"(, "byteLength": )" + std::to_string(length) + "}");
    gltf.add("images", R"({"mimeType": "image/png", "bufferView": )" + std::to_string(view) + "}");
  };
  image(0, png.size());
  image(0, png.size() - 1);
  Import import;
  test::import_text(gltf.text(), import);
  EXPECT_EQ(import.fault(), "scene.gltf: image 1: its buffer view overlaps that of another image");
}

TEST(MeshImport, tangents_are_made_exactly_where_a_normal_texture_is_used) {
  GltfText gltf;
  gltf.add("images", data_uri("image/png", test::make_png(1, 1, kRed)));
  gltf.add("textures", R"({"source": 0})");
  gltf.add("materials", R"({"normalTexture": {"index": 0}})");
  gltf.add("materials", R"({"emissiveTexture": {"index": 0}})");
  const std::string positions = std::to_string(gltf.floats({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3"));
  const std::string uv = std::to_string(gltf.floats({0, 1, 1, 1, 0, 0}, "VEC2"));
  gltf.mesh("\"POSITION\": " + positions + ", \"TEXCOORD_0\": " + uv, R"(, "material": 0)");
  gltf.mesh("\"POSITION\": " + positions + ", \"TEXCOORD_0\": " + uv, R"(, "material": 1)");
  Import import;
  const SceneAssets& assets = assets_of(gltf, import);
  ASSERT_EQ(assets.meshes.size(), 2u);
  EXPECT_THAT(assets.meshes[0].primitives[0].tangents,
              ElementsAre(vec4(1, 0, 0, 1), vec4(1, 0, 0, 1), vec4(1, 0, 0, 1)));
  EXPECT_THAT(assets.meshes[1].primitives[0].tangents, IsEmpty());
}

}  // namespace
}  // namespace gloam

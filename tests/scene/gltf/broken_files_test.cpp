// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>

#include <limits>

#include "tests/support/gltf_files.h"

namespace gloam {
namespace {

using test::GltfText;
using test::Import;
using ::testing::HasSubstr;

/// A broken file, and pieces that the message must contain.
struct Broken {
  const char* name;
  std::string text;
  std::vector<std::string> pieces;
};

/// Prints the name; by default, GoogleTest prints the bytes.
void PrintTo(const Broken& broken, std::ostream* out) { *out << broken.name; }

/// A file with these members and the asset.
std::string file(const std::string& members) { return R"({"asset": {"version": "2.0"}, )" + members + "}"; }

/// A file with one mesh whose positions are this accessor. The buffer holds 36 bytes of zeros.
std::string file_with_accessor(const std::string& accessor,
                               const std::string& view = R"({"buffer": 0, "byteLength": 36})") {
  return file(R"("buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,)" +
              test::base64(std::vector<std::uint8_t>(36)) + R"("}], "bufferViews": [)" + view + R"(], "accessors": [)" +
              accessor + R"(], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
              "nodes": [{"mesh": 0}])");
}

std::string file_with_positions(const std::vector<float>& positions) {
  GltfText gltf;
  gltf.mesh("\"POSITION\": " + std::to_string(gltf.floats(positions, "VEC3")));
  return gltf.text();
}

/// A triangle whose primitive has further attributes and members, with these 16-bit values as accessor 1.
std::string file_with_primitive(const std::string& attributes, const std::string& more,
                                const std::vector<std::uint16_t>& values = {0}, const std::string& type = "SCALAR") {
  GltfText gltf;
  gltf.floats({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3");
  gltf.accessor(values, 5123, type);
  gltf.mesh("\"POSITION\": 0" + attributes, more);
  return gltf.text();
}

std::string file_with_animation(
    const std::vector<float>& times, const std::vector<float>& values,
    const std::string& channel = R"({"sampler": 0, "target": {"node": 0, "path": "translation"}})",
    const std::string& interpolation = "LINEAR") {
  GltfText gltf;
  gltf.floats(times, "SCALAR");
  gltf.floats(values, "VEC3");
  gltf.add("nodes", "{}");
  gltf.add("animations", R"({"name": "spin", "samplers": [{"input": 0, "output": 1, "interpolation": ")" +
                             interpolation + R"("}], "channels": [)" + channel + "]}");
  return gltf.text();
}

/// A skinned triangle whose vertices all follow this joint, and a skin with one joint.
std::string file_with_joint(std::uint8_t joint) {
  GltfText gltf;
  gltf.floats({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3");
  gltf.accessor(std::vector<std::uint8_t>{joint, 0, 0, 0, joint, 0, 0, 0, joint, 0, 0, 0}, 5121, "VEC4");
  gltf.floats({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4");
  gltf.mesh(R"("POSITION": 0, "JOINTS_0": 1, "WEIGHTS_0": 2)");
  gltf.add("skins", R"({"joints": [0]})");
  gltf.add("nodes", R"({"name": "n", "mesh": 0, "skin": 0})");
  return gltf.text();
}

std::string file_with_image(const std::string& image) { return file(R"("images": [)" + image + "]"); }

std::string image_uri(const std::string& mime, std::string_view bytes) {
  const std::vector<std::uint8_t> data(bytes.begin(), bytes.end());
  return R"({"name": "wall", "uri": "data:)" + mime + ";base64," + test::base64(data) + "\"}";
}

const float kNan = std::numeric_limits<float>::quiet_NaN();
const float kInfinity = std::numeric_limits<float>::infinity();

std::vector<Broken> broken_texts() {
  return {
      {"empty", "", {"is empty"}},
      {"not_json", "this is not json", {"is not valid JSON", "line 1, column 2"}},
      {"cut_json", R"({"asset": {"version": "2.0"}, "nodes": [{)", {"is not valid JSON", "unexpected end of input"}},
      {"trailing_text", R"({"asset": {"version": "2.0"}} x)", {"is not valid JSON"}},
      {"number_overflow", file(R"("nodes": [{"scale": [1e999, 1, 1]}])"), {"is not valid JSON", "number overflow"}},
      {"bad_utf8", file("\"nodes\": [{\"name\": \"\xff\xfe\"}]"), {"is not valid JSON", "UTF-8"}},
      {"root_is_a_list", "[]", {"the root must be an object"}},
      {"root_is_a_number", "42", {"is not a glTF file: its root is not an object"}},
      {"nested_deeply",
       file(R"("extras": )" + std::string(100000, '[') + std::string(100000, ']')),
       {"is nested deeper than 96 levels"}},
      {"no_asset", R"({"nodes": []})", {"scene.gltf: asset is missing"}},
      {"no_version", R"({"asset": {}})", {"asset: version is missing"}},
      {"old_version_as_a_number", R"({"asset": {"version": 1}, "accessors": {}})", {"is glTF 1.0, only 2.x is read"}},
      {"version_as_a_number", R"({"asset": {"version": 2.0}})", {"asset: version must be a string"}},
      {"old_version", R"({"asset": {"version": "1.0"}, "nodes": {"a": {}}})", {"is glTF 1.0, only 2.x is read"}},
      {"nodes_not_a_list", file(R"("nodes": {"a": 1})"), {"scene.gltf: nodes must be an array"}},
      {"node_not_an_object", file(R"("nodes": [7])"), {"nodes[0] must be an object"}},
      {"member_given_twice", file(R"("nodes": [{"mesh": 0, "mesh": 0}])"), {"node 0: mesh is given twice"}},
      {"mesh_not_an_index",
       file(R"("nodes": [{"mesh": "wide"}])"),
       {"node 0: mesh must be an integer in 0…2147483647"}},
      {"mesh_negative", file(R"("nodes": [{"mesh": -1}])"), {"node 0: mesh must be an integer"}},
      {"mesh_over_32_bits",
       file(R"("nodes": [{"mesh": 4294967296}], "meshes": [{"primitives": []}])"),
       {"node 0: mesh must be an integer"}},
      {"mesh_out_of_range",
       file(R"("nodes": [{}, {"mesh": 1}], "meshes": [{"primitives": []}])"),
       {"node 1: mesh is 1, but the file has 1 meshes"}},
      {"child_out_of_range",
       file(R"("nodes": [{"children": [9]}])"),
       {"node 0: children is 9, but the file has 1 nodes"}},
      {"scene_out_of_range", file(R"("scene": 3, "scenes": [{}])"), {"scene is 3, but the file has 1 scenes"}},
      {"texture_out_of_range",
       file(R"("materials": [{"normalTexture": {"index": 0}}])"),
       {"material 0, normalTexture: index is 0, but the file has 0 textures"}},
      {"attribute_out_of_range",
       file(R"("meshes": [{"primitives": [{"attributes": {"NORMAL": 5}}]}])"),
       {"mesh 0, primitive 0, attributes: NORMAL is 5, but the file has 0 accessors"}},
      {"translation_too_short",
       file(R"("nodes": [{"translation": [1, 2]}])"),
       {"node 0: translation must be 3 numbers, has 2"}},
      {"rotation_of_texts", file(R"("nodes": [{"rotation": [0, 0, 0, "1"]}])"), {"rotation[3] must be a number"}},
      {"rotation_without_length",
       file(R"("nodes": [{"name": "n", "rotation": [0, 0, 0, 0]}])"),
       {"node 0 \"n\": its rotation has no length"}},
      {"matrix_too_long",
       file(R"("nodes": [{"matrix": [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1, 0]}])"),
       {"matrix must be 16 numbers, has 17"}},
      {"matrix_not_affine",
       file(R"("nodes": [{"matrix": [1,0,0,1, 0,1,0,0, 0,0,1,0, 0,0,0,1]}])"),
       {"node 0: the last row of its matrix"}},
      {"transform_not_finite",
       file(R"("nodes": [{"scale": [1e200, 1, 1], "children": [1]}, {"scale": [1e200, 1, 1]}])"),
       {"node 0: its transform is not finite"}},
      {"own_child", file(R"("nodes": [{"children": [0]}])"), {"node 0: it is its own ancestor"}},
      {"cycle",
       file(R"("nodes": [{"children": [1]}, {"children": [2]}, {"children": [1]}])"),
       {"node 1: it is a child of node 0 and again of node 2"}},
      {"ring",
       file(R"("nodes": [{"children": [1]}, {"children": [2]}, {"children": [0]}])"),
       {"node 0: it is its own ancestor or below one"}},
      {"two_parents",
       file(R"("nodes": [{"children": [2]}, {"children": [2]}, {"name": "c"}])"),
       {"node 2 \"c\": it is a child of node 0 and again of node 1"}},
      {"scene_root_is_a_child",
       file(R"("nodes": [{"children": [1]}, {}], "scenes": [{"nodes": [1]}])"),
       {"scene 0: node 1 is not a root"}},
      {"scene_lists_a_node_twice",
       file(R"("nodes": [{}], "scenes": [{"nodes": [0, 0]}])"),
       {"scene 0: it lists node 0 twice"}},
      {"node_weights_without_targets", file(R"("nodes": [{"weights": [1]}])"), {"node 0: it has 1 weights"}},
      {"required_extension",
       file(R"("extensionsRequired": ["KHR_texture_basisu"])"),
       {"\"KHR_texture_basisu\" is required, but not supported"}},
  };
}

std::vector<Broken> broken_buffers() {
  const std::string vec3 = R"("componentType": 5126, "type": "VEC3")";
  return {
      {"buffer_absent",
       file(R"("buffers": [{"byteLength": 4, "uri": "gone.bin"}])"),
       {"buffer 0: the file", "gone.bin\" is absent"}},
      {"buffer_without_uri", file(R"("buffers": [{"byteLength": 4}])"), {"buffer 0: it has no uri"}},
      {"buffer_of_length_0",
       file(R"("buffers": [{"byteLength": 0, "uri": "a"}])"),
       {"buffer 0: byteLength must be ≥ 1"}},
      {"buffer_is_a_folder", file(R"("buffers": [{"byteLength": 4, "uri": "."}])"), {"buffer 0: ", "is not a file"}},
      {"buffer_outside",
       file(R"("buffers": [{"byteLength": 4, "uri": "../x.bin"}])"),
       {"buffer 0: the path \"../x.bin\" leaves the scene's folder"}},
      {"buffer_absolute", file(R"("buffers": [{"byteLength": 4, "uri": "/dev/zero"}])"), {"leaves the scene's folder"}},
      {"buffer_too_short",
       file(R"("buffers": [{"byteLength": 9999, "uri": "data:application/octet-stream;base64,AAAA"}])"),
       {"buffer 0: its data URI does not hold byteLength = 9999 bytes"}},
      {"buffer_not_base64",
       file(R"("buffers": [{"byteLength": 4, "uri": "data:application/octet-stream,AAAA"}])"),
       {"buffer 0: its data URI must be"}},
      {"buffer_gigantic",
       file(R"("buffers": [{"byteLength": 18446744073709551615, "uri": "data:application/octet-stream;base64,AAAA"}])"),
       {"buffer 0: its data URI does not hold"}},
      {"view_past_buffer",
       file_with_accessor(R"({"bufferView": 0, "count": 3, )" + vec3 + "}", R"({"buffer": 0, "byteLength": 37})"),
       {"buffer view 0: it ends past its buffer of 36 bytes"}},
      {"view_offset_wraps",
       file_with_accessor(R"({"bufferView": 0, "count": 3, )" + vec3 + "}",
                          R"({"buffer": 0, "byteOffset": 18446744073709551612, "byteLength": 36})"),
       {"buffer view 0: it ends past its buffer"}},
      {"accessor_past_view",
       file_with_accessor(R"({"bufferView": 0, "count": 4, )" + vec3 + "}"),
       {"accessor 0: it ends past its buffer view of 36 bytes"}},
      {"accessor_offset_past_view",
       file_with_accessor(R"({"bufferView": 0, "byteOffset": 4, "count": 3, )" + vec3 + "}"),
       {"accessor 0: it ends past its buffer view"}},
      {"accessor_offset_wraps",
       file_with_accessor(R"({"bufferView": 0, "byteOffset": 18446744073709551612, "count": 3, )" + vec3 + "}"),
       {"accessor 0: it ends past its buffer view"}},
      {"accessor_stride_past_view",
       file_with_accessor(R"({"bufferView": 0, "count": 3, )" + vec3 + "}",
                          R"({"buffer": 0, "byteLength": 36, "byteStride": 16})"),
       {"accessor 0: it ends past its buffer view"}},
      {"stride_below_element",
       file_with_accessor(R"({"bufferView": 0, "count": 2, )" + vec3 + "}",
                          R"({"buffer": 0, "byteLength": 36, "byteStride": 8})"),
       {"accessor 0: byteStride 8 of its buffer view is less than an element of 12 bytes"}},
      {"count_0",
       file_with_accessor(R"({"bufferView": 0, "count": 0, )" + vec3 + "}"),
       {"accessor 0: count must be in 1…"}},
      {"count_gigantic",
       file_with_accessor(R"({"bufferView": 0, "count": 1099511627776, )" + vec3 + "}"),
       {"accessor 0: count must be in 1…4294967295, is 1099511627776"}},
      {"count_not_backed_by_bytes",
       file_with_accessor(R"({"count": 4000000000, )" + vec3 + "}"),
       {"mesh 0: its counts ask for more memory than"}},
      {"count_is_a_fraction",
       file_with_accessor(R"({"bufferView": 0, "count": 2.5, )" + vec3 + "}"),
       {"accessor 0: count must be an integer ≥ 0"}},
      {"component_type_unknown",
       file_with_accessor(R"({"bufferView": 0, "count": 1, "componentType": 5124, "type": "VEC3"})"),
       {"accessor 0: componentType 5124 is not one of glTF"}},
      {"type_unknown",
       file_with_accessor(R"({"bufferView": 0, "count": 1, "componentType": 5126, "type": "VEC5"})"),
       {"accessor 0: type must be one of", "is \"VEC5\""}},
      {"positions_of_two_components",
       file_with_accessor(R"({"bufferView": 0, "count": 1, "componentType": 5126, "type": "VEC2"})"),
       {"mesh 0, primitive 0: POSITION (accessor 0) must have 3 components"}},
      {"sparse_count_too_large",
       file_with_accessor(
           R"({"count": 1, "sparse": {"count": 2, "indices": {"bufferView": 0, "componentType": 5121}, "values": {"bufferView": 0}}, )" +
           vec3 + "}"),
       {"accessor 0: sparse.count must be in 1…1, is 2"}},
      {"sparse_values_past_view",
       file_with_accessor(
           R"({"count": 9, "sparse": {"count": 4, "indices": {"bufferView": 0, "componentType": 5121}, "values": {"bufferView": 0}}, )" +
           vec3 + "}"),
       {"accessor 0: its sparse values end past their buffer view"}},
      {"sparse_without_values",
       file_with_accessor(
           R"({"count": 9, "sparse": {"count": 1, "indices": {"bufferView": 0, "componentType": 5121}}, )" + vec3 +
           "}"),
       {"accessor 0, sparse: values is missing"}},
      {"position_nan",
       file_with_positions({0, 0, 0, 1, kNan, 0, 0, 1, 0}),
       {"mesh 0, primitive 0: accessor 0: element 1 is not finite"}},
      {"position_infinite",
       file_with_positions({0, 0, 0, 1, 0, 0, 0, kInfinity, 0}),
       {"accessor 0: element 2 is not finite"}},
      {"mode_unknown", file_with_primitive("", R"(, "mode": 7)"), {"mesh 0, primitive 0: mode must be in 0…6, is 7"}},
      {"index_past_vertices",
       file_with_primitive("", R"(, "indices": 1)", {0, 1, 3}),
       {"mesh 0, primitive 0: accessor 1: index 3 is past the 3 vertices"}},
      {"index_restart",
       file_with_primitive("", R"(, "indices": 1, "mode": 5)", {0, 1, 2, 65535}),
       {"index 65535 is past"}},
      {"indices_of_floats",
       file_with_primitive("", R"(, "indices": 0)"),
       {"indices (accessor 0) must be unsigned integers"}},
      {"attribute_counts_differ",
       file_with_primitive(R"(, "TEXCOORD_0": 1)", "", {0, 0, 0, 0}, "VEC2"),
       {"TEXCOORD_0 (accessor 1) has 2 elements, but there are 3 positions"}},
      {"joints_of_floats",
       file_with_primitive(R"(, "JOINTS_0": 0)", ""),
       {"JOINTS_0 (accessor 0) must have 4 components"}},
      {"targets_differ_in_length",
       file_with_primitive("", R"(, "targets": [{"POSITION": 1}])", {0, 0, 0}, "VEC3"),
       {"mesh 0, primitive 0, target 0: POSITION (accessor 1) has 1 elements"}},
      {"mesh_weights_without_targets",
       file(R"("meshes": [{"primitives": [], "weights": [1, 2]}])"),
       {"mesh 0: it has 2 weights, but 0 morph targets"}},
  };
}

std::vector<Broken> broken_parts() {
  const std::string gif = "GIF89a not a picture";
  return {
      {"times_not_increasing",
       file_with_animation({0, 1, 1}, std::vector<float>(9, 0.0f)),
       {"animation 0 \"spin\", channel 0: its times (accessor 0) must increase strictly"}},
      {"times_negative",
       file_with_animation({-1, 1}, std::vector<float>(6, 0.0f)),
       {"its times (accessor 0) must be ≥ 0"}},
      {"times_nan",
       file_with_animation({0, kNan}, std::vector<float>(6, 0.0f)),
       {"accessor 0: element 1 is not finite"}},
      {"values_nan", file_with_animation({0, 1}, {0, 0, 0, 0, kNan, 0}), {"accessor 1: element 1 is not finite"}},
      {"values_too_few",
       file_with_animation({0, 1, 2}, std::vector<float>(6, 0.0f)),
       {"its values (accessor 1) must be 3 of 3 components, are 2 of 3"}},
      {"cubic_values_too_few",
       file_with_animation({0, 1}, std::vector<float>(6, 0.0f),
                           R"({"sampler": 0, "target": {"node": 0, "path": "scale"}})", "CUBICSPLINE"),
       {"must be 6 of 3 components"}},
      {"rotation_of_three_components",
       file_with_animation({0, 1}, std::vector<float>(6, 0.0f),
                           R"({"sampler": 0, "target": {"node": 0, "path": "rotation"}})"),
       {"must be 2 of 4 components, are 2 of 3"}},
      {"weights_without_targets",
       file_with_animation({0, 1}, std::vector<float>(6, 0.0f),
                           R"({"sampler": 0, "target": {"node": 0, "path": "weights"}})"),
       {"it moves the weights of node 0, which has no morph targets"}},
      {"interpolation_unknown",
       file_with_animation({0, 1}, std::vector<float>(6, 0.0f),
                           R"({"sampler": 0, "target": {"node": 0, "path": "scale"}})", "WILD"),
       {"interpolation must be one of LINEAR STEP CUBICSPLINE, is \"WILD\""}},
      {"sampler_out_of_range",
       file_with_animation({0, 1}, std::vector<float>(6, 0.0f),
                           R"({"sampler": 4, "target": {"node": 0, "path": "scale"}})"),
       {"animation 0 \"spin\": a channel's sampler is 4, but it has 1 samplers"}},
      {"skin_without_joints", file(R"("nodes": [{}], "skins": [{"joints": []}])"), {"skin 0: it has no joints"}},
      {"joint_out_of_range",
       file(R"("nodes": [{}], "skins": [{"joints": [1]}])"),
       {"skin 0: joints is 1, but the file has 1 nodes"}},
      {"joint_past_its_skin", file_with_joint(1), {"node 0 \"n\": its mesh names joint 1, but its skin has 1"}},
      {"camera_type_unknown",
       file(R"("cameras": [{"type": "fisheye"}])"),
       {"camera 0: type must be one of perspective orthographic, is \"fisheye\""}},
      {"camera_flat",
       file(
           R"("nodes": [{"camera": 0}], "cameras": [{"type": "perspective", "perspective": {"yfov": 0, "znear": 1}}])"),
       {"camera 0: yfov must be in 0…π"}},
      {"camera_rounded_to_half_a_turn",
       file(
           R"("nodes": [{"camera": 0}], "cameras": [{"type": "perspective", "perspective": {"yfov": 3.14159265, "znear": 1}}])"),
       {"camera 0: yfov must be in 0…π"}},
      {"camera_rounded_to_0",
       file(
           R"("nodes": [{"camera": 0}], "cameras": [{"type": "perspective", "perspective": {"yfov": 1e-60, "znear": 1}}])"),
       {"camera 0: yfov must be in 0…π"}},
      {"camera_near_0",
       file(
           R"("nodes": [{"camera": 0}], "cameras": [{"type": "perspective", "perspective": {"yfov": 1, "znear": 0}}])"),
       {"camera 0: znear must be > 0"}},
      {"camera_inside_out",
       file(
           R"("nodes": [{"camera": 0}], "cameras": [{"type": "perspective", "perspective": {"yfov": 1, "znear": 2, "zfar": 1}}])"),
       {"camera 0: zfar must be larger than znear"}},
      {"camera_without_extent",
       file(
           R"("nodes": [{"camera": 0}], "cameras": [{"type": "orthographic", "orthographic": {"xmag": 0, "ymag": 1, "znear": 0, "zfar": 1}}])"),
       {"camera 0: xmag and ymag must not be 0"}},
      {"alpha_mode_unknown",
       file(R"("materials": [{"name": "m", "alphaMode": "GLASS"}])"),
       {"material 0: alphaMode must be one of OPAQUE MASK BLEND, is", "\"GLASS\""}},
      {"factor_too_large",
       file(R"("materials": [{"normalTexture": {"index": 0, "scale": 1e300}}], "textures": [{}])"),
       {"material 0: a factor is too large"}},
      {"wrap_unknown",
       file(R"("samplers": [{"wrapS": 1}], "textures": [{"sampler": 0}])"),
       {"sampler 0: its wrap mode must be"}},
      {"image_absent", file_with_image(R"({"uri": "gone.png"})"), {"image 0 \"gone.png\": the file", "is absent"}},
      {"image_outside", file_with_image(R"({"uri": "%2e%2e/x.png"})"), {"image 0", "leaves the scene's folder"}},
      {"image_past_buffer",
       file(R"("buffers": [{"byteLength": 3, "uri": "data:application/octet-stream;base64,AAAA"}],)"
            R"("bufferViews": [{"buffer": 0, "byteOffset": 18446744073709551615, "byteLength": 3}],)"
            R"("images": [{"mimeType": "image/png", "bufferView": 0}])"),
       {"buffer view 0: it ends past its buffer of 3 bytes"}},
      {"image_at_the_end_of_a_buffer",
       file(R"("buffers": [{"byteLength": 3, "uri": "data:application/octet-stream;base64,AAAA"}],)"
            R"("bufferViews": [{"buffer": 0, "byteOffset": 3, "byteLength": 1}],)"
            R"("images": [{"mimeType": "image/png", "bufferView": 0}])"),
       {"buffer view 0: it ends past its buffer of 3 bytes"}},
      {"image_in_view_minus_0",
       file(R"("buffers": [{"byteLength": 3, "uri": "data:application/octet-stream;base64,AAAA"}],)"
            R"("bufferViews": [{"byteLength": 3, "byteOffset": 18446744073709551615, "buffer": -0}],)"
            R"("images": [{"mimeType": "image/png", "bufferView": -0}])"),
       {"buffer view 0: it ends past its buffer of 3 bytes"}},
      {"image_without_source", file_with_image(R"({"name": "wall"})"), {"image"}},
      {"image_of_other_kind",
       file_with_image(image_uri("image/gif", gif)),
       {"image 0 \"wall\": is not a PNG, JPEG or WebP image"}},
      {"image_of_unknown_mime",
       file_with_image(image_uri("image/avif", gif)),
       {"image 0 \"wall\": its data URI is not image/png"}},
      {"image_that_is_no_image",
       file_with_image(image_uri("image/png", "\x89PNG\r\n\x1a\n and then nothing of use at all")),
       {"image 0 \"wall\": is not an image that can be read"}},
  };
}

class BrokenFiles : public ::testing::TestWithParam<Broken> {};

// Hard case: scene.index_out_of_range, scene.accessor_past_buffer, scene.cycle, scene.position_not_finite
// Hard case: scene.absent_file, scene.gigantic_count, scene.required_extension
TEST_P(BrokenFiles, are_refused_in_one_sentence_that_names_file_place_and_fault) {
  Import import;
  test::import_text(GetParam().text, import);
  ASSERT_FALSE(import.ok());
  EXPECT_EQ(import.result.error().kind, ErrorKind::input);
  EXPECT_THAT(import.fault(), ::testing::StartsWith("scene.gltf"));
  EXPECT_EQ(import.fault().find('\n'), std::string::npos);
  for (const std::string& piece : GetParam().pieces) EXPECT_THAT(import.fault(), HasSubstr(piece));
}

std::string broken_name(const ::testing::TestParamInfo<Broken>& info) { return info.param.name; }

INSTANTIATE_TEST_SUITE_P(texts, BrokenFiles, ::testing::ValuesIn(broken_texts()), broken_name);
INSTANTIATE_TEST_SUITE_P(buffers, BrokenFiles, ::testing::ValuesIn(broken_buffers()), broken_name);
INSTANTIATE_TEST_SUITE_P(parts, BrokenFiles, ::testing::ValuesIn(broken_parts()), broken_name);

}  // namespace
}  // namespace gloam

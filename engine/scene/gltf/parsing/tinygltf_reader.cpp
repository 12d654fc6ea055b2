// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/scene/gltf/parsing/tinygltf_reader.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <exception>
#include <nlohmann/json.hpp>
#include <span>
#include <utility>

#include "engine/scene/gltf/parsing/material_read.h"
#include "engine/scene/gltf/place.h"
#include "engine/scene/scene_path.h"

namespace gloam::gltf {
namespace {

std::uint32_t index_of(int value) { return value < 0 ? kNone : static_cast<std::uint32_t>(value); }

std::vector<std::uint32_t> indices_of(const std::vector<int>& values) {
  std::vector<std::uint32_t> result(values.size());
  std::transform(values.begin(), values.end(), result.begin(), index_of);
  return result;
}

// ---- files ----

/// State of read_file. tinygltf asks for the files of buffers first, then of images, each in file order.
struct FileRequests {
  const JsonScan& scan;
  const std::string& directory;
  std::size_t buffer = 0;  ///< next one to look at
  std::string fault;
};

bool file_exists(const std::string&, void*) { return true; }
std::string same_path(const std::string& path, void*) { return path; }
bool write_nothing(std::string*, const std::string&, const std::vector<unsigned char>&, void*) { return false; }

/// Ignores the path, which tinygltf decodes by its own rules; the scan holds the URI as written.
bool read_file(std::vector<unsigned char>* out, std::string*, const std::string&, void* user) {
  auto& requests = *static_cast<FileRequests*>(user);
  const std::vector<ByteSource>& buffers = requests.scan.buffers;
  std::size_t& i = requests.buffer;
  while (i < buffers.size() && (buffers[i].uri.empty() || buffers[i].data_uri || buffers[i].fallback)) ++i;
  if (i >= buffers.size()) {
    out->assign(1, 0);  // an image: its file is read later, when it is decoded
    return true;
  }
  const std::string where = place("buffer", i);
  const ByteSource& source = buffers[i++];
  Result<std::string> path = resolve_scene_path(requests.directory, source.uri);
  if (!path) {
    requests.fault = where + ": " + path.error().message;
    return false;
  }
  Result<std::vector<std::uint8_t>> bytes = read_scene_file(*path, source.byte_length);
  if (!bytes) {
    requests.fault = where + ": " + bytes.error().message;
    return false;
  }
  *out = std::move(*bytes);
  return true;
}

/// Keeps the bytes of images that are embedded in the text. Other images are found later by URI or buffer view.
bool keep_image(tinygltf::Image* image, int, std::string*, std::string*, int, int, const unsigned char* bytes, int size,
                void*) {
  if (image->uri.empty() && image->bufferView < 0) image->image.assign(bytes, bytes + size);
  return true;
}

Status check_byte_sources(const JsonScan& scan, const Container& file) {
  for (std::size_t i = 0; i < scan.buffers.size(); ++i) {
    const ByteSource& source = scan.buffers[i];
    if (source.fallback) continue;
    if (source.byte_length == 0) return fault_at(place("buffer", i), "byteLength must be ≥ 1");
    if (source.uri.empty() && !(file.binary && i == 0 && file.has_binary_chunk))
      return fault_at(place("buffer", i), "it has no uri, and there is no binary chunk for it");
    if (source.data_uri && !tinygltf::IsDataURI(source.uri))
      return fault_at(place("buffer", i), "its data URI must be application/octet-stream in base64");
  }
  return {};
}

/// tinygltf takes the address of each image's bytes before anything else is checked.
Status check_image_bytes(const JsonScan& scan) {
  for (const ByteSource& image : scan.images) {
    if (image.view >= scan.views.size()) continue;  // none, or refused as a reference
    const ViewSource& view = scan.views[image.view];
    const std::string where = place("buffer view", image.view);
    if (view.buffer >= scan.buffers.size()) return fault_at(where, "it has no buffer");
    const ByteSource& buffer = scan.buffers[view.buffer];
    if (view.length == 0) return fault_at(where, "byteLength must be ≥ 1");
    if (buffer.fallback) return fault_at(where, "an image cannot lie in a fallback buffer");
    if (view.offset > buffer.byte_length || view.length > buffer.byte_length - view.offset)
      return fault_at(where, "it ends past its buffer of " + std::to_string(buffer.byte_length) + " bytes");
  }
  return {};
}

/// The numbers of spot lights without a `spot` object. They have the default cone, but tinygltf refuses them.
std::vector<std::size_t> spots_without_cone(const JsonScan& scan) {
  std::vector<std::size_t> spots;
  const SceneValue* extension = scan.root_extensions.find("KHR_lights_punctual");
  const SceneValue* lights = extension != nullptr ? extension->find("lights") : nullptr;
  for (std::size_t i = 0; lights != nullptr && i < lights->items.size(); ++i) {
    const SceneValue* type = lights->items[i].find("type");
    if (type != nullptr && type->text == "spot" && lights->items[i].find("spot") == nullptr) spots.push_back(i);
  }
  return spots;
}

// tinygltf decodes a data URI of the second type, but not of the first.
constexpr std::string_view kWebpUri = "data:image/webp;base64,";
constexpr std::string_view kPngUri = "data:image/png;base64,";

std::vector<std::size_t> embedded_webps(const JsonScan& scan) {
  std::vector<std::size_t> images;
  for (std::size_t i = 0; i < scan.images.size(); ++i)
    if (scan.images[i].uri.starts_with(kWebpUri)) images.push_back(i);
  return images;
}

/// The index accessor of a primitive that is hidden from tinygltf.
struct HiddenIndices {
  std::size_t mesh = 0;
  std::size_t primitive = 0;
  std::uint32_t accessor = kNone;
};

/// What tinygltf is not shown of a file, because it refuses it.
struct Hidden {
  std::vector<std::size_t> spots;      ///< lights without a `spot` object
  std::vector<std::size_t> webps;      ///< images in data URIs of a type that it does not know
  std::vector<HiddenIndices> indices;  ///< of compressed meshes: their accessors have no buffer view
};

void hide_indices(nlohmann::json& root, Hidden& hidden) {
  if (!root.contains("meshes")) return;
  nlohmann::json& meshes = root["meshes"];
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    nlohmann::json& primitives = meshes[m]["primitives"];
    for (std::size_t p = 0; p < primitives.size(); ++p) {
      if (!primitives[p].contains("indices")) continue;
      const auto accessor = primitives[p]["indices"].get<std::uint32_t>();
      if (root["accessors"][accessor].contains("bufferView")) continue;
      hidden.indices.push_back({m, p, accessor});
      primitives[p].erase("indices");
    }
  }
}

/// A copy of the file that tinygltf reads: fallback buffers, whose content is never read, hold one byte, because it
/// wants a uri, spots have a `spot` object, and a WebP counts as a PNG. Indices of compressed meshes are left out and
/// noted in `hidden`.
Container made_readable(const Container& file, const JsonScan& scan, Hidden& hidden) {
  nlohmann::json root = nlohmann::json::parse(file.json());
  if (scan.compressed_meshes) hide_indices(root, hidden);
  for (std::size_t i = 0; i < scan.buffers.size(); ++i)
    if (scan.buffers[i].fallback)
      root["buffers"][i] = {{"byteLength", 1}, {"uri", "data:application/octet-stream;base64,AA=="}};
  for (const std::size_t i : hidden.webps) {
    std::string uri = root["images"][i]["uri"];
    root["images"][i]["uri"] = uri.replace(0, kWebpUri.size(), kPngUri);
  }
  for (const std::size_t i : hidden.spots)
    root["extensions"]["KHR_lights_punctual"]["lights"][i]["spot"] = nlohmann::json::object();
  const std::string text = root.dump();
  std::vector<std::uint8_t> bytes;
  if (!file.binary) {
    bytes.assign(text.begin(), text.end());
  } else {
    const auto put_word = [&bytes](std::uint64_t value) {
      for (int shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<std::uint8_t>(value >> shift));
    };
    const std::size_t end = file.json_offset + file.json_size;
    const std::span<const std::uint8_t> chunks = std::span(file.bytes).first(file.length).subspan(end);
    const std::uint64_t json_size = (text.size() + 3) / 4 * 4;
    const std::uint64_t json_offset = file.json_offset;
    bytes.assign(file.bytes.begin(), file.bytes.begin() + 8);
    put_word(json_offset + json_size + chunks.size());
    put_word(json_size);
    bytes.insert(bytes.end(), file.bytes.begin() + 16, file.bytes.begin() + 20);
    bytes.insert(bytes.end(), text.begin(), text.end());
    bytes.resize(json_offset + json_size, ' ');
    bytes.insert(bytes.end(), chunks.begin(), chunks.end());
  }
  Container copy;
  copy.binary = file.binary;
  copy.has_binary_chunk = file.has_binary_chunk;
  copy.json_offset = file.json_offset;
  copy.json_size = text.size();
  copy.length = bytes.size();
  copy.bytes = std::move(bytes);
  return copy;
}

Result<tinygltf::Model> load_model(const Container& file, const JsonScan& scan, const std::string& directory) {
  FileRequests requests{scan, directory, 0, {}};
  tinygltf::TinyGLTF loader;
  loader.SetFsCallbacks({&file_exists, &same_path, &read_file, &write_nothing, &requests});
  loader.SetImageLoader(&keep_image, nullptr);
  tinygltf::Model model;
  std::string errors;
  std::string warnings;
  const auto size = static_cast<unsigned int>(file.bytes.size());
  bool loaded = false;
  try {
    loaded = file.binary ? loader.LoadBinaryFromMemory(&model, &errors, &warnings, file.bytes.data(), size, "")
                         : loader.LoadASCIIFromString(&model, &errors, &warnings, file.json().data(), size, "");
  } catch (const std::exception& exception) {
    errors = exception.what();
  }
  if (loaded) return model;
  if (!requests.fault.empty()) return Error{ErrorKind::input, requests.fault};
  const std::size_t failed = model.buffers.size();
  if (failed < scan.buffers.size() && scan.buffers[failed].data_uri)
    return fault_at(place("buffer", failed), "its data URI does not hold byteLength = " +
                                                 std::to_string(scan.buffers[failed].byte_length) + " bytes of base64");
  // Remarks that are no errors come first.
  while (errors.ends_with('\n')) errors.pop_back();
  return Error{ErrorKind::input, one_line(errors.substr(errors.rfind('\n') + 1), 200)};
}

// ---- geometry ----

std::uint32_t component_count(int type) {
  switch (type) {
    case TINYGLTF_TYPE_SCALAR:
      return 1;
    case TINYGLTF_TYPE_VEC2:
      return 2;
    case TINYGLTF_TYPE_VEC3:
      return 3;
    case TINYGLTF_TYPE_VEC4:
      return 4;
    case TINYGLTF_TYPE_MAT4:
      return 16;
    default:
      return 0;
  }
}

std::uint64_t size_at(const tinygltf::Value& object, const char* name) {
  return object.Has(name) ? static_cast<std::uint64_t>(object.Get(name).GetNumberAsDouble()) : 0;
}

std::string text_at(const tinygltf::Value& object, const char* name) {
  return object.Has(name) ? object.Get(name).Get<std::string>() : std::string();
}

/// The scan has checked types and words.
CompressedSource translate_compressed(const tinygltf::Value& source) {
  using Mode = CompressedSource::Mode;
  using Filter = CompressedSource::Filter;
  CompressedSource compressed;
  compressed.buffer = index_of(source.Get("buffer").GetNumberAsInt());
  compressed.offset = size_at(source, "byteOffset");
  compressed.length = size_at(source, "byteLength");
  compressed.stride = size_at(source, "byteStride");
  compressed.count = size_at(source, "count");
  const std::string mode = text_at(source, "mode");
  const std::string filter = text_at(source, "filter");
  compressed.mode = mode == "TRIANGLES" ? Mode::triangles : mode == "INDICES" ? Mode::indices : Mode::attributes;
  compressed.filter = filter == "OCTAHEDRAL"    ? Filter::octahedral
                      : filter == "QUATERNION"  ? Filter::quaternion
                      : filter == "EXPONENTIAL" ? Filter::exponential
                                                : Filter::none;
  return compressed;
}

BufferView translate(const tinygltf::BufferView& source) {
  BufferView view{index_of(source.buffer), source.byteOffset, source.byteLength, source.byteStride, {}};
  if (const auto found = source.extensions.find("EXT_meshopt_compression"); found != source.extensions.end())
    view.compressed = translate_compressed(found->second);
  return view;
}

Accessor translate(const tinygltf::Accessor& source) {
  Accessor accessor;
  accessor.view = index_of(source.bufferView);
  accessor.offset = source.byteOffset;
  accessor.count = source.count;
  accessor.component_type = static_cast<ComponentType>(source.componentType);
  accessor.components = component_count(source.type);
  accessor.normalized = source.normalized;
  if (source.sparse.isSparse) {
    SparseSource sparse;
    sparse.count = static_cast<std::uint64_t>(source.sparse.count);
    sparse.index_view = index_of(source.sparse.indices.bufferView);
    sparse.index_offset = static_cast<std::uint64_t>(source.sparse.indices.byteOffset);
    sparse.index_type = static_cast<ComponentType>(source.sparse.indices.componentType);
    sparse.value_view = index_of(source.sparse.values.bufferView);
    sparse.value_offset = static_cast<std::uint64_t>(source.sparse.values.byteOffset);
    accessor.sparse = sparse;
  }
  return accessor;
}

std::uint32_t attribute(const std::map<std::string, int>& attributes, const char* name) {
  const auto found = attributes.find(name);
  return found == attributes.end() ? kNone : index_of(found->second);
}

PrimitiveSource translate(const tinygltf::Primitive& source) {
  PrimitiveSource primitive;
  primitive.mode = source.mode;
  primitive.material = index_of(source.material);
  primitive.indices = index_of(source.indices);
  primitive.position = attribute(source.attributes, "POSITION");
  primitive.normal = attribute(source.attributes, "NORMAL");
  primitive.tangent = attribute(source.attributes, "TANGENT");
  primitive.uv0 = attribute(source.attributes, "TEXCOORD_0");
  primitive.uv1 = attribute(source.attributes, "TEXCOORD_1");
  primitive.color = attribute(source.attributes, "COLOR_0");
  primitive.joints = attribute(source.attributes, "JOINTS_0");
  primitive.weights = attribute(source.attributes, "WEIGHTS_0");
  primitive.more_influences = attribute(source.attributes, "JOINTS_1") != kNone;
  for (const std::map<std::string, int>& target : source.targets)
    primitive.targets.push_back({attribute(target, "POSITION"), attribute(target, "NORMAL")});
  if (const auto found = source.extensions.find("KHR_draco_mesh_compression"); found != source.extensions.end()) {
    CompressedMesh mesh;
    mesh.view = index_of(found->second.Get("bufferView").GetNumberAsInt());
    for (const auto& [name, id] : found->second.Get("attributes").Get<tinygltf::Value::Object>())
      mesh.attributes.emplace_back(name, index_of(id.GetNumberAsInt()));
    primitive.compressed = std::move(mesh);
  }
  return primitive;
}

MeshSource translate(const tinygltf::Mesh& source) {
  MeshSource mesh;
  mesh.name = source.name;
  mesh.weights = source.weights;
  for (const tinygltf::Primitive& primitive : source.primitives) mesh.primitives.push_back(translate(primitive));
  return mesh;
}

// ---- content ----

ImageSource translate(tinygltf::Image&& source) {
  ImageSource image;
  image.name = source.name;
  image.uri = source.uri;
  image.view = index_of(source.bufferView);
  image.bytes = std::move(source.image);
  return image;
}

dvec3 vec3_of(const std::vector<double>& values, const dvec3& otherwise) {
  return values.size() == 3 ? dvec3(values[0], values[1], values[2]) : otherwise;
}

NodeSource translate(const tinygltf::Node& source) {
  NodeSource node;
  node.name = source.name;
  node.children = indices_of(source.children);
  node.mesh = index_of(source.mesh);
  node.skin = index_of(source.skin);
  node.camera = index_of(source.camera);
  node.weights = source.weights;
  if (source.matrix.size() == 16) {
    dmat4 matrix;
    for (int i = 0; i < 16; ++i) matrix[i / 4][i % 4] = source.matrix[static_cast<std::size_t>(i)];
    node.matrix = matrix;
  }
  node.pose.translation = vec3_of(source.translation, dvec3(0.0));
  node.pose.scale = vec3_of(source.scale, dvec3(1.0));
  if (const std::vector<double>& r = source.rotation; r.size() == 4) node.pose.rotation = dquat(r[3], r[0], r[1], r[2]);
  if (const auto found = source.extensions.find("EXT_mesh_gpu_instancing"); found != source.extensions.end()) {
    const tinygltf::Value& attributes = found->second.Get("attributes");
    const auto accessor = [&](const char* name) {
      return attributes.Has(name) ? index_of(attributes.Get(name).GetNumberAsInt()) : kNone;
    };
    node.instancing = {accessor("TRANSLATION"), accessor("ROTATION"), accessor("SCALE")};
  }
  return node;
}

/// The texture's image; of EXT_texture_webp where it has both.
TextureSource translate(const tinygltf::Texture& source) {
  TextureSource texture{source.name, index_of(source.source), index_of(source.sampler)};
  const auto found = source.extensions.find("EXT_texture_webp");
  if (found != source.extensions.end() && found->second.Has("source"))
    texture.image = index_of(found->second.Get("source").GetNumberAsInt());
  return texture;
}

/// Marks images that are only what other readers take in place of a WebP.
void mark_fallbacks(const std::vector<tinygltf::Texture>& textures, Document& document) {
  std::vector<bool> read(document.images.size());
  for (const TextureSource& texture : document.textures)
    if (texture.image != kNone) read[texture.image] = true;
  for (const tinygltf::Texture& texture : textures)
    if (texture.source >= 0 && !read[index_of(texture.source)])
      document.images[index_of(texture.source)].fallback = true;
}

SkinSource translate(const tinygltf::Skin& source) {
  return {source.name, indices_of(source.joints), index_of(source.inverseBindMatrices)};
}

AnimationSource translate(const tinygltf::Animation& source) {
  AnimationSource animation;
  animation.name = source.name;
  for (const tinygltf::AnimationSampler& sampler : source.samplers)
    animation.samplers.push_back({index_of(sampler.input), index_of(sampler.output), sampler.interpolation});
  for (const tinygltf::AnimationChannel& channel : source.channels)
    animation.channels.push_back({index_of(channel.sampler), index_of(channel.target_node), channel.target_path});
  return animation;
}

CameraSource translate(const tinygltf::Camera& source) {
  CameraSource camera;
  camera.name = source.name;
  camera.orthographic = source.type == "orthographic";
  camera.yfov = source.perspective.yfov;
  camera.xmag = source.orthographic.xmag;
  camera.ymag = source.orthographic.ymag;
  camera.znear = camera.orthographic ? source.orthographic.znear : source.perspective.znear;
  camera.zfar = camera.orthographic ? source.orthographic.zfar : source.perspective.zfar;
  return camera;
}

template <class From, class To>
void translate_all(const std::vector<From>& from, std::vector<To>& to) {
  to.reserve(from.size());
  for (const From& item : from) to.push_back(translate(item));
}

}  // namespace

Result<Document> read_document(const Container& file, const JsonScan& scan, const std::string& directory) {
  GLOAM_TRY(check_byte_sources(scan, file));
  GLOAM_TRY(check_image_bytes(scan));
  const bool fallbacks = std::ranges::any_of(scan.buffers, &ByteSource::fallback);
  Hidden hidden{.spots = spots_without_cone(scan), .webps = embedded_webps(scan), .indices = {}};
  const bool readable = !fallbacks && !scan.compressed_meshes && hidden.spots.empty() && hidden.webps.empty();
  Result<tinygltf::Model> loaded =
      !readable ? load_model(made_readable(file, scan, hidden), scan, directory) : load_model(file, scan, directory);
  if (!loaded) return loaded.error();
  tinygltf::Model& model = *loaded;
  Document document;
  for (tinygltf::Buffer& buffer : model.buffers) document.buffers.push_back(std::move(buffer.data));
  document.file_buffers = document.buffers.size();
  translate_all(model.bufferViews, document.views);
  translate_all(model.accessors, document.accessors);
  translate_all(model.meshes, document.meshes);
  for (const HiddenIndices& indices : hidden.indices)
    document.meshes[indices.mesh].primitives[indices.primitive].indices = indices.accessor;
  for (std::size_t i = 0; i < model.materials.size(); ++i) {
    const std::string where = place("material", i, model.materials[i].name);
    Result<Material> material = read_material(model.materials[i]);
    if (!material) return fault_at(where, material.error().message);
    document.materials.push_back(std::move(*material));
    if (has_transmission_texture(model.materials[i]))
      document.warnings.push_back(where + ": the texture of KHR_materials_transmission is not read, only its factor");
  }
  translate_all(model.textures, document.textures);
  for (const tinygltf::Sampler& sampler : model.samplers)
    document.samplers.push_back({sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST, sampler.wrapS, sampler.wrapT});
  for (tinygltf::Image& image : model.images) document.images.push_back(translate(std::move(image)));
  mark_fallbacks(model.textures, document);
  translate_all(model.skins, document.skins);
  translate_all(model.animations, document.animations);
  translate_all(model.cameras, document.cameras);
  translate_all(model.nodes, document.nodes);
  for (const tinygltf::Scene& scene : model.scenes) document.scenes.push_back({scene.name, indices_of(scene.nodes)});
  document.default_scene = index_of(model.defaultScene);
  return document;
}

}  // namespace gloam::gltf

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "tests/support/gltf_files.h"

#include <unistd.h>

#include <atomic>
#include <filesystem>
#include <fstream>

#include "engine/jobs/executor.h"
#include "engine/scene/components.h"

#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#define STBI_WRITE_NO_STDIO
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb/stb_image_write.h>
#pragma GCC diagnostic pop

namespace gloam::test {
namespace {

namespace fs = std::filesystem;

struct TestLight {
  double index = 0.0;
};

void append_bytes(void* context, void* data, int size) {
  auto& out = *static_cast<std::vector<std::uint8_t>*>(context);
  const auto* bytes = static_cast<const std::uint8_t*>(data);
  out.insert(out.end(), bytes, bytes + size);
}

std::vector<std::uint8_t> fill(int width, int height, std::span<const std::uint8_t, 4> color) {
  std::vector<std::uint8_t> pixels;
  for (int i = 0; i < width * height; ++i) pixels.insert(pixels.end(), color.begin(), color.end());
  return pixels;
}

void put_word(std::vector<std::uint8_t>& out, std::size_t value) {
  for (int i = 0; i < 4; ++i) out.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
}

std::size_t component_count(const std::string& type) {
  if (type == "SCALAR") return 1;
  if (type == "MAT4") return 16;
  return static_cast<std::size_t>(type.back() - '0');
}

SceneKey key(KeyElement on, std::string name, KeyType type) {
  SceneKey result;
  result.module = "test";
  result.on = on;
  result.name = std::move(name);
  result.type = type;
  return result;
}

}  // namespace

TemporaryFolder::TemporaryFolder() {
  static std::atomic<int> count = 0;
  path_ = (fs::temp_directory_path() /
           ("gloam_test_" + std::to_string(::getpid()) + "_" + std::to_string(count.fetch_add(1))))
              .string();
  fs::remove_all(path_);
  fs::create_directories(path_);
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

std::string TemporaryFolder::write(const std::string& name, std::string_view content) const {
  const fs::path file = fs::path(path_) / name;
  fs::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary).write(content.data(), static_cast<std::streamsize>(content.size()));
  return file.string();
}

std::string TemporaryFolder::write(const std::string& name, std::span<const std::uint8_t> content) const {
  return write(name, std::string_view(reinterpret_cast<const char*>(content.data()), content.size()));
}

int GltfText::add(const std::string& array, const std::string& json) {
  arrays_[array].push_back(json);
  return static_cast<int>(arrays_[array].size()) - 1;
}

int GltfText::view(std::span<const std::byte> bytes, const std::string& more) {
  while (buffer_.size() % 4 != 0) buffer_.push_back(0);
  const std::size_t offset = buffer_.size();
  for (const std::byte b : bytes) buffer_.push_back(static_cast<std::uint8_t>(b));
  return add("bufferViews", R"({"buffer": 0, "byteOffset": )" + std::to_string(offset) + R"(, "byteLength": )" +
                                std::to_string(bytes.size()) + more + "}");
}

int GltfText::accessor(int view, std::size_t values, int component_type, const std::string& type,
                       const std::string& more) {
  return add("accessors", R"({"bufferView": )" + std::to_string(view) + R"(, "componentType": )" +
                              std::to_string(component_type) + R"(, "count": )" +
                              std::to_string(values / component_count(type)) + R"(, "type": ")" + type + "\"" + more +
                              "}");
}

int GltfText::mesh(const std::string& attributes, const std::string& more) {
  return add("meshes", R"({"primitives": [{"attributes": {)" + attributes + "}" + more + "}]}");
}

int GltfText::triangle() {
  const int positions = floats({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3");
  return mesh("\"POSITION\": " + std::to_string(positions));
}

std::string GltfText::json(const std::string& buffer) const {
  std::string text = "{";
  const auto member = [&text](const std::string& name, const std::string& json) {
    text += (text.size() > 1 ? ",\n" : "\n") + ("\"" + name + "\": ") + json;
  };
  for (const auto& [name, json] : members_) member(name, json);
  for (const auto& [name, items] : arrays_) {
    std::string list;
    for (const std::string& item : items) list += (list.empty() ? "" : ", ") + item;
    member(name, "[" + list + "]");
  }
  if (!buffer_.empty() && !arrays_.contains("buffers")) member("buffers", "[" + buffer + "]");
  return text + "\n}\n";
}

std::string GltfText::text(const std::string& uri) const {
  const std::string source = uri.empty() ? "data:application/octet-stream;base64," + base64(buffer_) : uri;
  return json(R"({"byteLength": )" + std::to_string(buffer_.size()) + R"(, "uri": ")" + source + "\"}");
}

std::vector<std::uint8_t> GltfText::glb() const {
  return make_glb(json(R"({"byteLength": )" + std::to_string(buffer_.size()) + "}"), buffer_);
}

std::string base64(std::span<const std::uint8_t> bytes) {
  constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) group = group << 8 | (i + k < bytes.size() ? bytes[i + k] : 0u);
    for (std::size_t k = 0; k < 4; ++k) text += i + k <= bytes.size() ? kDigits[group >> (18 - 6 * k) & 63u] : '=';
  }
  return text;
}

std::vector<std::uint8_t> make_glb(std::string json, std::span<const std::uint8_t> bin) {
  while (json.size() % 4 != 0) json += ' ';
  std::vector<std::uint8_t> chunk(bin.begin(), bin.end());
  while (chunk.size() % 4 != 0) chunk.push_back(0);
  std::vector<std::uint8_t> glb;
  put_word(glb, 0x46546c67);
  put_word(glb, 2);
  put_word(glb, 20 + json.size() + (chunk.empty() ? 0 : 8 + chunk.size()));
  put_word(glb, json.size());
  put_word(glb, 0x4e4f534a);
  glb.insert(glb.end(), json.begin(), json.end());
  if (chunk.empty()) return glb;
  put_word(glb, chunk.size());
  put_word(glb, 0x004e4942);
  glb.insert(glb.end(), chunk.begin(), chunk.end());
  return glb;
}

std::vector<std::uint8_t> make_png(int width, int height, std::span<const std::uint8_t, 4> color) {
  return encode_png(width, height, 4, fill(width, height, color));
}

std::vector<std::uint8_t> encode_png(int width, int height, int channels, std::span<const std::uint8_t> pixels,
                                     int filter) {
  std::vector<std::uint8_t> file;
  stbi_write_force_png_filter = filter;
  stbi_write_png_to_func(&append_bytes, &file, width, height, channels, pixels.data(), width * channels);
  return file;
}

std::vector<std::uint8_t> make_jpeg(int width, int height, std::span<const std::uint8_t, 4> color) {
  std::vector<std::uint8_t> file;
  stbi_write_jpg_to_func(&append_bytes, &file, width, height, 4, fill(width, height, color).data(), 95);
  return file;
}

KeyRegistry light_registry() {
  KeyRegistry registry;
  add_engine_keys(registry);
  SceneKey width = key(KeyElement::light_node, "gloam.light.width", KeyType::number);
  width.min = 0.0;
  width.unit = "m";
  registry.add(std::move(width));
  registry.add(key(KeyElement::node, "gloam.closeup", KeyType::boolean));
  registry.add(key(KeyElement::mesh_node, "gloam.grass.density", KeyType::number));
  registry.add(key(KeyElement::camera_node, "gloam.dof.focus", KeyType::number));
  SceneExtension lights;
  lights.module = "test";
  lights.name = "KHR_lights_punctual";
  lights.on_node = [](KeyTarget& target, const SceneValue& node) -> Status {
    const SceneValue* light = node.find("light");
    if (light == nullptr) return Error{ErrorKind::input, "has no light"};
    target.world.register_component<TestLight>("test_light");
    target.world.add(target.entity, TestLight{light->number});
    return {};
  };
  registry.add_extension(std::move(lights));
  registry.set_light_test([](const World& world, Entity entity) {
    return world.is_registered<TestLight>() && world.has<TestLight>(entity);
  });
  return registry;
}

void import_file(const std::string& path, Import& import, const ImportOptions& options, const KeyRegistry& registry) {
  FunctionLog log([&import](LogLevel, std::string_view line) { import.log.emplace_back(line); });
  const auto executor = make_serial_executor();
  import.result = import_gltf(path, options, registry, import.world, *executor, log);
}

void import_text(const std::string& text, Import& import, const ImportOptions& options, const KeyRegistry& registry) {
  const TemporaryFolder folder;
  import_file(folder.write("scene.gltf", text), import, options, registry);
}

}  // namespace gloam::test

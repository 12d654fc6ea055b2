// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/log.h"
#include "engine/core/result.h"
#include "engine/ecs/world.h"
#include "engine/scene/gltf/import.h"
#include "engine/scene/keys/registry.h"

namespace gloam::test {

/// A new folder in the system's temporary folder. The destructor removes it with everything in it.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  [[nodiscard]] const std::string& path() const { return path_; }
  /// Writes a file, with the folders it needs, and returns its path.
  std::string write(const std::string& name, std::string_view content) const;
  std::string write(const std::string& name, std::span<const std::uint8_t> content) const;

 private:
  std::string path_;
};

/// Builds a glTF file item by item. Arrays of the root are lists of JSON texts; numbers go into one buffer, which is
/// embedded.
class GltfText {
 public:
  /// Appends an item to an array of the root and returns its index.
  int add(const std::string& array, const std::string& json);
  /// Sets any other member of the root.
  void set(const std::string& member, const std::string& json) { members_[member] = json; }

  /// Appends bytes (4-aligned) to the buffer as a buffer view and returns its index. `more`: further members, ",
  /// \"byteStride\": 8".
  int view(std::span<const std::byte> bytes, const std::string& more = {});
  template <class T>
  int view_of(const std::vector<T>& values) {
    return view(std::as_bytes(std::span(values)));
  }
  /// Appends the values as an accessor with a buffer view of its own and returns its index. component_type: glTF's
  /// number; type: "SCALAR", "VEC3", …
  template <class T>
  int accessor(const std::vector<T>& values, int component_type, const std::string& type,
               const std::string& more = {}) {
    return accessor(view(std::as_bytes(std::span(values))), values.size(), component_type, type, more);
  }
  int floats(const std::vector<float>& values, const std::string& type) { return accessor(values, 5126, type); }
  /// Appends a mesh with one primitive and returns its index. `attributes`: e.g. "\"POSITION\": 0"; `more`: e.g. ",
  /// \"indices\": 1".
  int mesh(const std::string& attributes, const std::string& more = {});
  /// Appends a mesh of one triangle (0,0,0), (1,0,0), (0,1,0) and returns its index.
  int triangle();

  /// The whole file. The buffer is a data URI, or the external file `uri` if that is given.
  [[nodiscard]] std::string text(const std::string& uri = {}) const;
  [[nodiscard]] std::vector<std::uint8_t> glb() const;
  [[nodiscard]] const std::vector<std::uint8_t>& buffer() const { return buffer_; }

 private:
  int accessor(int view, std::size_t values, int component_type, const std::string& type, const std::string& more);
  [[nodiscard]] std::string json(const std::string& buffer) const;

  std::map<std::string, std::vector<std::string>> arrays_;
  std::map<std::string, std::string> members_ = {{"asset", R"({"version": "2.0"})"}};
  std::vector<std::uint8_t> buffer_;
};

[[nodiscard]] std::string base64(std::span<const std::uint8_t> bytes);
/// A GLB file: header, JSON chunk and BIN chunk (none if `bin` is empty), padded as glTF requires.
[[nodiscard]] std::vector<std::uint8_t> make_glb(std::string json, std::span<const std::uint8_t> bin);

/// Encoded images of one RGBA colour.
[[nodiscard]] std::vector<std::uint8_t> make_png(int width, int height, std::span<const std::uint8_t, 4> color);
[[nodiscard]] std::vector<std::uint8_t> make_jpeg(int width, int height, std::span<const std::uint8_t, 4> color);

/// An encoded image of any pixels with 1 to 4 channels. filter: the PNG filter of every row, 0…4; −1: the encoder
/// chooses.
[[nodiscard]] std::vector<std::uint8_t> encode_png(int width, int height, int channels,
                                                   std::span<const std::uint8_t> pixels, int filter = -1);

/// The engine's own keys, and keys that store nothing but stand for those of the engine's modules: gloam.light.width
/// (light node, number ≥ 0 m), gloam.closeup (node, boolean), gloam.grass.density (mesh node), gloam.dof.focus (camera
/// node), and KHR_lights_punctual, whose nodes count as lights.
[[nodiscard]] KeyRegistry light_registry();

/// One import and the world that it fills.
struct Import {
  World world;
  Result<SceneInfo> result = Error{};
  std::vector<std::string> log;

  [[nodiscard]] bool ok() const { return result.ok(); }
  /// Message of the error; "" if the import succeeded.
  [[nodiscard]] std::string fault() const { return ok() ? "" : result.error().message; }
  [[nodiscard]] const SceneInfo& info() const { return result.value(); }
  [[nodiscard]] Entity node(std::size_t index) const { return info().node_entities[index]; }
};

/// Imports a file into `import.world`, serially.
void import_file(const std::string& path, Import& import, const ImportOptions& options = {},
                 const KeyRegistry& registry = light_registry());
/// Writes the text to scene.gltf in a temporary folder and imports it as import_file does.
void import_text(const std::string& text, Import& import, const ImportOptions& options = {},
                 const KeyRegistry& registry = light_registry());

}  // namespace gloam::test

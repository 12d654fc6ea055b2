// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/session/loading/scene_files.h"

#include <cctype>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string_view>

#include "engine/core/hash.h"
#include "sandbox/output/file_io.h"

namespace gloam {
namespace {

/// The JSON of a .gltf file, or of a .glb file's first chunk.
std::string_view json_of(std::string_view file) {
  constexpr std::size_t kHeader = 20;  // magic, version, length; length and type of the first chunk
  if (!file.starts_with("glTF") || file.size() < kHeader) return file;
  std::size_t length = 0;
  for (std::size_t byte = 4; byte-- > 0;) length = length << 8 | static_cast<unsigned char>(file[12 + byte]);
  return file.substr(kHeader, length);
}

/// A URI's text with its %XX replaced.
std::string path_of(const std::string& uri) {
  std::string path;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    const bool coded = uri[i] == '%' && i + 2 < uri.size() && std::isxdigit(static_cast<unsigned char>(uri[i + 1])) &&
                       std::isxdigit(static_cast<unsigned char>(uri[i + 2]));
    path += coded ? static_cast<char>(std::stoi(uri.substr(i + 1, 2), nullptr, 16)) : uri[i];
    if (coded) i += 2;
  }
  return path;
}

}  // namespace

std::uint64_t scene_files_hash(const std::string& scene) {
  if (scene.starts_with("builtin:")) return 0;
  const auto file = read_text_file(scene, ErrorKind::input);
  if (!file) return 0;
  Hasher hasher;
  hasher.text(*file);
  const auto json = nlohmann::json::parse(json_of(*file), nullptr, false);
  if (!json.is_object()) return hasher.digest();
  for (const char* kind : {"buffers", "images"}) {
    if (!json.contains(kind) || !json[kind].is_array()) continue;
    for (const auto& item : json[kind]) {
      if (!item.is_object() || !item.contains("uri") || !item["uri"].is_string()) continue;
      const auto uri = item["uri"].get<std::string>();
      if (uri.starts_with("data:")) continue;
      const auto content =
          read_text_file((std::filesystem::path(scene).parent_path() / path_of(uri)).string(), ErrorKind::input);
      hasher.text(content ? *content : std::string());
    }
  }
  return hasher.digest();
}

}  // namespace gloam

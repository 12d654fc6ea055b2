// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/scene/scene_path.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <system_error>

#include "engine/core/text/plain_text.h"

namespace gloam {
namespace {

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

std::string percent_decoded(std::string_view uri) {
  std::string text;
  text.reserve(uri.size());
  for (std::size_t i = 0; i < uri.size(); ++i) {
    const int high = uri[i] == '%' && i + 2 < uri.size() ? hex_digit(uri[i + 1]) : -1;
    const int low = high >= 0 ? hex_digit(uri[i + 2]) : -1;
    if (low < 0) {
      text += uri[i];
    } else {
      text += static_cast<char>(high * 16 + low);
      i += 2;
    }
  }
  return text;
}

/// Whether the path, followed part by part, ever goes above its start. Backslashes count as separators, as on Windows.
bool leaves_folder(std::string_view path) {
  int depth = 0;
  std::size_t begin = 0;
  while (begin <= path.size()) {
    const std::size_t end = std::min(path.find_first_of("/\\", begin), path.size());
    const std::string_view part = path.substr(begin, end - begin);
    if (part == "..")
      --depth;
    else if (!part.empty() && part != ".")
      ++depth;
    if (depth < 0) return true;
    begin = end + 1;
  }
  return false;
}

/// Whether one letter and a colon name a drive, also if they were encoded.
#ifdef _WIN32
constexpr bool kDrives = true;
#else
constexpr bool kDrives = false;
#endif

/// Whether the URI begins with a scheme ("file:…", "https://…") or the name of a drive ("C:…"): letters, digits and
/// signs before the first colon. An encoded colon ("%3A") and one after other characters are parts of a name.
bool has_scheme(std::string_view uri) {
  constexpr std::string_view kSigns = "+-.";
  const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  const std::string_view before = uri.substr(0, uri.find(':'));
  return before.size() < uri.size() && !before.empty() && letter(before.front()) &&
         std::ranges::all_of(before, [&](char c) {
           return letter(c) || (c >= '0' && c <= '9') || kSigns.find(c) != std::string_view::npos;
         });
}

Error path_fault(std::string sentence) { return {ErrorKind::input, std::move(sentence)}; }

}  // namespace

Result<std::string> resolve_scene_path(const std::string& directory, std::string_view uri) {
  const std::string path = percent_decoded(uri);
  if (path.empty()) return path_fault("the path of a file is empty");
  if (path.find('\0') != std::string::npos) return path_fault("the path " + in_quotes(path) + " holds a zero byte");
  const bool absolute = path.front() == '/' || path.front() == '\\';
  const bool drive = kDrives && path.size() > 1 && path[1] == ':';
  if (absolute || has_scheme(uri) || drive || leaves_folder(path))
    return path_fault("the path " + in_quotes(path) + " leaves the scene's folder");
  const std::string normal = std::filesystem::path(path).lexically_normal().string();
  return directory.empty() ? normal : directory + "/" + normal;
}

Result<std::vector<std::uint8_t>> read_scene_file(const std::string& path, std::uint64_t wanted_bytes) {
  std::error_code code;
  const std::filesystem::file_status status = std::filesystem::status(path, code);
  if (!std::filesystem::exists(status)) return path_fault("the file " + in_quotes(path) + " is absent");
  // Reading a device or a pipe may never end.
  if (!std::filesystem::is_regular_file(status)) return path_fault(in_quotes(path) + " is not a file");
  const std::uint64_t size = std::filesystem::file_size(path, code);
  if (code) return path_fault("the file " + in_quotes(path) + " cannot be read: " + code.message());
  if (wanted_bytes != ~std::uint64_t{0} && size < wanted_bytes)
    return path_fault("the file " + in_quotes(path) + " has " + std::to_string(size) + " bytes, needs " +
                      std::to_string(wanted_bytes));
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
  if (!file) return path_fault("the file " + in_quotes(path) + " cannot be read: " + std::strerror(errno));
  std::vector<std::uint8_t> bytes(std::min(size, wanted_bytes));
  if (std::fread(bytes.data(), 1, bytes.size(), file.get()) != bytes.size())
    return path_fault("the file " + in_quotes(path) + " cannot be read to its end");
  return bytes;
}

}  // namespace gloam

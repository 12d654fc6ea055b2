// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/core/storage/sealed_file.h"

#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "engine/core/assert.h"
#include "engine/core/hash.h"

namespace gloam {
namespace {

constexpr std::string_view kMagic = "gloam sealed 1 ";

std::string checksum_of(std::string_view identity, std::string_view payload) {
  char digits[17];
  std::snprintf(digits, sizeof(digits), "%016llx",
                static_cast<unsigned long long>(Hasher().text(identity).text(payload).digest()));
  return digits;
}

}  // namespace

Status write_whole_file(const std::string& path, std::string_view bytes) {
  const auto failed = [&path](const std::string& reason) {
    return Error{ErrorKind::failed, path + ": cannot be written: " + reason};
  };
  std::error_code fault;
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  if (!folder.empty()) std::filesystem::create_directories(folder, fault);
  if (fault) return failed(fault.message());
  const std::string partial = path + ".partial";
  errno = 0;
  std::ofstream file(partial, std::ios::binary | std::ios::trunc);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (!file) return failed(std::generic_category().message(errno == 0 ? EIO : errno));
  std::filesystem::rename(partial, path, fault);
  if (fault) return failed(fault.message());
  return {};
}

Status write_sealed(const std::string& path, std::string_view identity, std::string_view payload) {
  GLOAM_ASSERT(identity.find('\n') == std::string_view::npos, "a sealed file's identity is one line");
  std::string text(kMagic);
  text.append(checksum_of(identity, payload)).append("\n").append(identity).append("\n").append(payload);
  return write_whole_file(path, text);
}

std::optional<std::string> read_sealed(const std::string& path, std::string_view identity) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return std::nullopt;
  std::error_code fault;
  const std::uintmax_t size = std::filesystem::file_size(path, fault);
  if (fault) return std::nullopt;
  std::string text(size, '\0');
  if (!file.read(text.data(), static_cast<std::streamsize>(size))) return std::nullopt;
  const std::size_t head_size = kMagic.size() + 16 + 1 + identity.size() + 1;
  if (text.size() < head_size) return std::nullopt;
  std::string payload = text.substr(head_size);
  std::string head(kMagic);
  head.append(checksum_of(identity, payload)).append("\n").append(identity).append("\n");
  if (text.compare(0, head_size, head) != 0) return std::nullopt;
  return payload;
}

std::string hash_text(std::string_view text) { return checksum_of({}, text); }

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/core/storage/sealed_file.h"

#include <cerrno>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <system_error>
#include <thread>
#include <utility>

#include "engine/core/assert.h"
#include "engine/core/hash.h"
#include "engine/core/system/process.h"

namespace gloam {
namespace {

constexpr std::string_view kMagic = "gloam sealed 1 ";

std::string checksum_of(std::string_view identity, std::string_view payload) {
  char digits[17];
  std::snprintf(digits, sizeof(digits), "%016llx",
                static_cast<unsigned long long>(Hasher().text(identity).text(payload).digest()));
  return digits;
}

/// Names of new files: .gloam-TARGET-HOST-PROCESS-UNIQUE.partial, hexadecimal; the first two are hashes. Empty where
/// the host has no name.
std::string partial_prefix(const std::filesystem::path& target) {
  const std::string host = host_name();
  if (host.empty()) return {};
  char prefix[48];
  std::snprintf(prefix, sizeof(prefix), ".gloam-%08llx-%08llx-",
                static_cast<unsigned long long>(Hasher().text(target.filename().string()).digest() >> 32),
                static_cast<unsigned long long>(Hasher().text(host).digest() >> 32));
  return prefix;
}

/// Removes new files of the target whose writers were killed: of processes of this host that no longer exist.
void remove_left_files(const std::filesystem::path& target) {
  const std::string prefix = partial_prefix(target);
  std::error_code fault;
  const std::filesystem::path folder = target.has_parent_path() ? target.parent_path() : ".";
  std::filesystem::directory_iterator files(folder, fault);
  if (prefix.empty() || fault) return;
  for (; files != std::filesystem::directory_iterator(); files.increment(fault)) {
    const std::string name = files->path().filename().string();
    unsigned process = 0;
    if (!name.starts_with(prefix) || !name.ends_with(".partial") ||
        std::sscanf(name.c_str() + prefix.size(), "%x-", &process) != 1 || process == 0)
      continue;
    std::error_code ignored;
    if (!process_exists(process)) std::filesystem::remove(files->path(), ignored);
    if (fault) return;
  }
}

/// A file of a name that no other one has, in the folder of the file that it will replace. Unless it is renamed, it is
/// removed in the end.
class NewFile {
 public:
  explicit NewFile(const std::filesystem::path& target) {
    const std::string prefix = partial_prefix(target);
    for (int attempt = 0; attempt < 100 && file_ == nullptr; ++attempt) {
      const std::uint64_t unique = Hasher()
                                       .value(std::chrono::steady_clock::now().time_since_epoch().count())
                                       .value(std::hash<std::thread::id>()(std::this_thread::get_id()))
                                       .value(attempt)
                                       .digest();
      char name[40];
      std::snprintf(name, sizeof(name), "%x-%016llx.partial", process_number(),
                    static_cast<unsigned long long>(unique));
      path_ = target.parent_path() / ((prefix.empty() ? ".gloam-" : prefix) + name);
      file_ = std::fopen(path_.string().c_str(), "wbx");  // x: fails if another process has made the file
      if (file_ == nullptr && errno != EEXIST) break;
    }
    made_ = file_ != nullptr;
  }
  ~NewFile() {
    const int reason = errno;
    if (file_ != nullptr) std::fclose(file_);
    std::error_code ignored;
    if (made_) std::filesystem::remove(path_, ignored);
    errno = reason;
  }
  NewFile(const NewFile&) = delete;
  NewFile& operator=(const NewFile&) = delete;

  [[nodiscard]] bool is_open() const { return file_ != nullptr; }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  /// Writes all bytes and closes the file. `replaces`: they must be on the disk before they take an old file's place.
  [[nodiscard]] bool write(std::string_view bytes, bool replaces) {
    const bool written = std::fwrite(bytes.data(), 1, bytes.size(), file_) == bytes.size() && std::fflush(file_) == 0 &&
                         (!replaces || flush_to_disk(file_));
    const bool closed = std::fclose(std::exchange(file_, nullptr)) == 0;
    return written && closed;
  }
  [[nodiscard]] bool rename_to(const std::filesystem::path& target, std::error_code& fault) {
    std::filesystem::rename(path_, target, fault);
    made_ = static_cast<bool>(fault);
    return !fault;
  }

 private:
  std::filesystem::path path_;
  std::FILE* file_ = nullptr;
  bool made_ = false;  ///< there is a file at path_
};

}  // namespace

Status write_whole_file(const std::string& path, std::string_view bytes) {
  const auto failed = [&path](const std::string& reason) {
    return Error{ErrorKind::failed, path + ": cannot be written: " + reason};
  };
  std::error_code fault;
  // A link stays: the file that it names is replaced.
  const std::filesystem::path given(path);
  const std::filesystem::path target = std::filesystem::is_symlink(given, fault) ? canonical(given, fault) : given;
  if (fault && fault != std::errc::no_such_file_or_directory) return failed(fault.message());
  const std::filesystem::path folder = target.parent_path();
  if (!folder.empty()) std::filesystem::create_directories(folder, fault);
  if (!folder.empty() && fault) return failed(fault.message());
  remove_left_files(target);
  NewFile file(target);
  if (!file.is_open()) return failed(std::generic_category().message(errno));
  const std::filesystem::file_status old = std::filesystem::status(target, fault);
  if (std::filesystem::is_regular_file(old)) std::filesystem::permissions(file.path(), old.permissions(), fault);
  errno = 0;
  if (!file.write(bytes, std::filesystem::exists(old)))
    return failed(std::generic_category().message(errno == 0 ? EIO : errno));
  if (!file.rename_to(target, fault)) return failed(fault.message());
  return {};
}

Status write_sealed(const std::string& path, std::string_view identity, std::string_view payload) {
  GLOAM_ASSERT(identity.find('\n') == std::string_view::npos, "a sealed file's identity is one line");
  std::string text(kMagic);
  text.append(checksum_of(identity, payload)).append("\n").append(identity).append("\n").append(payload);
  return write_whole_file(path, text);
}

std::optional<std::string> read_sealed(const std::string& path, std::string_view identity) {
  // The size is that of the open file: another process may replace the file at any time.
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  const std::streamoff size = file.tellg();
  if (!file || size < 0 || !file.seekg(0)) return std::nullopt;
  std::string text(static_cast<std::size_t>(size), '\0');
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

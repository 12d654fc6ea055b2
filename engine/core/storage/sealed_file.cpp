// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/core/storage/sealed_file.h"

#include <array>
#include <atomic>
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

constexpr std::size_t kLongestPath = 1024;
enum class SlotState : std::uint8_t { free, filling, noted };
static_assert(std::atomic<SlotState>::is_always_lock_free);

/// A path where a handler of a signal finds it.
struct PathSlot {
  std::atomic<SlotState> state{SlotState::free};
  char path[kLongestPath] = {};
};
std::array<PathSlot, 16> path_slots;

/// The path of a file that is being written, in a slot.
class UnfinishedFile {
 public:
  /// A path that is too long, or of more files than threads usually write at once, is not noted: the next writer of the
  /// same target removes that file.
  void note(const std::string& path) {
    if (path.size() >= kLongestPath) return;
    for (PathSlot& slot : path_slots) {
      SlotState free = SlotState::free;
      if (!slot.state.compare_exchange_strong(free, SlotState::filling)) continue;
      path.copy(slot.path, path.size());
      slot.path[path.size()] = '\0';
      slot.state.store(SlotState::noted);
      slot_ = &slot;
      return;
    }
  }
  void forget() {
    if (slot_ != nullptr) slot_->state.store(SlotState::free);
    slot_ = nullptr;
  }

 private:
  PathSlot* slot_ = nullptr;
};

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
      unfinished_.note(path_.string());
      file_ = std::fopen(path_.string().c_str(), "wbx");  // x: fails if another process has made the file
      if (file_ != nullptr) break;
      unfinished_.forget();
      if (errno != EEXIST) break;
    }
    made_ = file_ != nullptr;
  }
  ~NewFile() {
    const int reason = errno;
    if (file_ != nullptr) std::fclose(file_);
    std::error_code ignored;
    if (made_) std::filesystem::remove(path_, ignored);
    unfinished_.forget();
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
  UnfinishedFile unfinished_;
  bool made_ = false;  ///< there is a file at path_
};

SealedFault read_whole(const std::string& path, std::string& text) {
  std::error_code fault;
  const std::filesystem::file_status status = std::filesystem::status(path, fault);
  if (!std::filesystem::exists(status)) return SealedFault::absent;
  if (!std::filesystem::is_regular_file(status)) return SealedFault::not_a_file;
  // The size is that of the open file: another process may replace the file at any time.
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  const std::streamoff size = file.tellg();
  if (!file || size < 0 || !file.seekg(0)) return SealedFault::unreadable;
  text.resize(static_cast<std::size_t>(size));
  return file.read(text.data(), static_cast<std::streamsize>(size)) ? SealedFault::none : SealedFault::unreadable;
}

/// The file that a path names, through all links; it need not exist.
std::filesystem::path without_links(std::filesystem::path path) {
  constexpr int kMostLinks = 40;
  std::error_code fault;
  for (int links = 0; links < kMostLinks && std::filesystem::is_symlink(path, fault); ++links)
    path = path.parent_path() / std::filesystem::read_symlink(path, fault);  // an absolute target replaces the folder
  return path;
}

}  // namespace

Status write_whole_file(const std::string& path, std::string_view bytes) {
  const auto failed = [&path](const std::string& reason) {
    return Error{ErrorKind::failed, path + ": cannot be written: " + reason};
  };
  std::error_code fault;
  // A link stays: the file that it names is replaced.
  const std::filesystem::path target = without_links(path);
  if (std::filesystem::is_symlink(target, fault)) return failed(std::generic_category().message(ELOOP));
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

std::string_view text_of(SealedFault fault) {
  switch (fault) {
    case SealedFault::none:
      return "is sound";
    case SealedFault::absent:
      return "does not exist";
    case SealedFault::not_a_file:
      return "is not a file";
    case SealedFault::unreadable:
      return "cannot be read";
    case SealedFault::damaged:
      return "is damaged";
    case SealedFault::other:
      return "is of another version or of something else";
  }
  return {};
}

std::optional<std::string> read_sealed(const std::string& path, std::string_view identity, SealedFault* fault) {
  SealedFault ignored = SealedFault::none;
  SealedFault& reason = fault == nullptr ? ignored : *fault;
  std::string text;
  reason = read_whole(path, text);
  if (reason != SealedFault::none) return std::nullopt;
  reason = SealedFault::damaged;
  constexpr std::size_t kChecksumSize = 16;
  const std::size_t identity_at = kMagic.size() + kChecksumSize + 1;
  const std::size_t identity_end = text.find('\n', identity_at);
  if (!text.starts_with(kMagic) || identity_end == std::string::npos || text[identity_at - 1] != '\n')
    return std::nullopt;
  const std::string_view own_identity = std::string_view(text).substr(identity_at, identity_end - identity_at);
  const std::string_view payload = std::string_view(text).substr(identity_end + 1);
  if (text.compare(kMagic.size(), kChecksumSize, checksum_of(own_identity, payload)) != 0) return std::nullopt;
  reason = own_identity == identity ? SealedFault::none : SealedFault::other;
  if (reason != SealedFault::none) return std::nullopt;
  return std::string(payload);
}

void remove_unfinished_files() {
  for (const PathSlot& slot : path_slots)
    if (slot.state.load() == SlotState::noted) remove_in_handler(slot.path);
}

std::string hash_text(std::string_view text) { return checksum_of({}, text); }

}  // namespace gloam

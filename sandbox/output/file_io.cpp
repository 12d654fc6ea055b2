// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/output/file_io.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <system_error>

#include "engine/core/storage/sealed_file.h"
#include "sandbox/console.h"

namespace gloam {
namespace {

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

std::string reason() { return std::generic_category().message(errno); }

/// The number of the standard stream that a path names itself or by links: 1 for standard output, 2 for standard error;
/// 0: another file.
int standard_stream(const std::string& path) {
  namespace fs = std::filesystem;
  constexpr int kMostLinks = 40;
  std::error_code fault;
  fs::path at(path);
  for (int links = 0; links < kMostLinks; ++links) {
    const fs::path folder = fs::weakly_canonical(fs::absolute(at, fault).parent_path(), fault);
    if (fault) return 0;
    at = folder / at.filename();
    const bool own = folder == fs::weakly_canonical("/proc/self/fd", fault);
    if (at == "/dev/stdout" || (own && at.filename() == "1")) return 1;
    if (at == "/dev/stderr" || (own && at.filename() == "2")) return 2;
    if (!fs::is_symlink(at, fault)) return 0;
    at = folder / fs::read_symlink(at, fault);  // an absolute target replaces the folder
  }
  return 0;
}

}  // namespace

Result<std::string> read_text_file(const std::string& path, ErrorKind kind) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) return Error{kind, path + ": is a folder, not a file"};
  const File file(std::fopen(path.c_str(), "rb"));
  if (!file) return Error{kind, path + ": cannot be read: " + reason()};
  std::string text;
  char block[65536];
  for (std::size_t got = 0; (got = std::fread(block, 1, sizeof(block), file.get())) > 0;) text.append(block, got);
  if (std::ferror(file.get()) != 0) return Error{kind, path + ": cannot be read: " + reason()};
  return text;
}

Status write_file(const std::string& path, std::string_view bytes) {
  if (const int stream = standard_stream(path); stream > 0) {
    if (Console::write_stream(stream, bytes)) return {};
    return Error{ErrorKind::failed, path + ": cannot be written: " + reason()};
  }
  std::error_code fault;
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  if (!folder.empty() && !std::filesystem::is_directory(folder, fault))
    return Error{ErrorKind::failed, path + ": cannot be written: " + std::generic_category().message(ENOENT)};
  const std::filesystem::file_status old = std::filesystem::status(path, fault);
  if (!std::filesystem::exists(old) || std::filesystem::is_regular_file(old)) return write_whole_file(path, bytes);
  File file(std::fopen(path.c_str(), "wb"));  // a device or a pipe
  if (!file) return Error{ErrorKind::failed, path + ": cannot be written: " + reason()};
  if (std::fwrite(bytes.data(), 1, bytes.size(), file.get()) != bytes.size() || std::fclose(file.release()) != 0)
    return Error{ErrorKind::failed, path + ": cannot be written: " + reason()};
  return {};
}

Status make_folder_of(const std::string& path) {
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  if (folder.empty()) return {};
  std::error_code fault;
  std::filesystem::create_directories(folder, fault);
  if (fault) return Error{ErrorKind::failed, folder.string() + ": the folder cannot be made: " + fault.message()};
  return {};
}

}  // namespace gloam

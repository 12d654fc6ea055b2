// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/output/file_io.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <system_error>

namespace gloam {
namespace {

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

std::string reason() { return std::generic_category().message(errno); }

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
  File file(std::fopen(path.c_str(), "wb"));
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

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/play/shader_reload.h"

#include <sys/wait.h>

#include <array>
#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <map>
#include <system_error>
#include <utility>

#include "sandbox/output/file_io.h"
#include "shaders/every/shaders.h"

namespace gloam {
namespace {

constexpr auto kPause = std::chrono::milliseconds(300);  // between two looks at the files

std::string quoted(const std::string& word) {
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

/// Runs a shell command. The error is what it printed.
Status run_compiler(const std::string& command) {
  FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  if (pipe == nullptr) return Error{ErrorKind::failed, "cannot start: " + command};
  std::string printed;
  std::array<char, 4096> block{};
  while (const std::size_t count = std::fread(block.data(), 1, block.size(), pipe)) printed.append(block.data(), count);
  const int status = pclose(pipe);
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return {};
  return Error{ErrorKind::input, printed.empty() ? "failed: " + command : printed};
}

/// A file of its own in the temporary folder, removed at the end.
class TemporaryFile {
 public:
  TemporaryFile() {
    std::error_code fault;
    std::string name = (std::filesystem::temp_directory_path(fault) / "gloam-shader-XXXXXX").string();
    const int file = mkstemp(name.data());
    if (file < 0) return;
    close(file);
    path_ = name;
  }
  ~TemporaryFile() {
    std::error_code fault;
    if (!path_.empty()) std::filesystem::remove(path_, fault);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  std::string path_;
};

/// "comp" of "shaders/fog/blur.comp.glsl".
std::string stage_of(const std::string& file) {
  return std::filesystem::path(file).stem().extension().string().substr(1);
}

}  // namespace

std::string file_of(const gpu::ShaderCode& shader) { return "shaders/" + std::string(shader.name) + ".glsl"; }

Result<std::vector<std::uint32_t>> compile_shader(const std::string& root, const std::string& file) {
  const TemporaryFile spirv;
  if (spirv.path().empty()) return Error{ErrorKind::failed, "no file can be made in the temporary folder"};
  const std::string out = quoted(spirv.path());
  GLOAM_TRY(run_compiler("cd " + quoted(root) + " && " + quoted(GLOAM_GLSLANG_VALIDATOR) +
                         " --quiet -V --target-env vulkan1.3 -S " + quoted(stage_of(file)) + " -I. -o " + out + " " +
                         quoted(file)));
  GLOAM_TRY(run_compiler(quoted(GLOAM_SPIRV_OPT) + " " GLOAM_SPIRV_PASSES " " + out + " -o " + out));
  const auto bytes = read_text_file(spirv.path(), ErrorKind::failed);
  if (!bytes.ok()) return bytes.error();
  std::vector<std::uint32_t> words(bytes->size() / sizeof(std::uint32_t));
  if (!words.empty()) std::memcpy(words.data(), bytes->data(), words.size() * sizeof(std::uint32_t));
  return words;
}

ShaderReload::ShaderReload(std::string root) : root_(std::move(root)) {
  std::error_code fault;
  if (std::filesystem::is_directory(std::filesystem::path(root_) / "shaders", fault))
    thread_ = std::jthread([this](const std::stop_token& stop) { watch(stop); });
}

std::optional<ShaderReload::Change> ShaderReload::take() {
  const std::lock_guard lock(mutex_);
  return std::exchange(change_, std::nullopt);
}

void ShaderReload::watch(const std::stop_token& stop) {
  ShaderFiles files(root_);
  std::vector<std::string> shaders;
  for (const gpu::ShaderCode* shader : every_shader()) shaders.push_back(file_of(*shader));
  std::condition_variable_any wake;
  std::mutex unused;
  std::unique_lock lock(unused);
  while (!wake.wait_for(lock, stop, kPause, [&] { return stop.stop_requested(); })) {
    const std::vector<std::string> changed = files.changed();
    if (changed.empty()) continue;
    Change change = compile(files.that_include(shaders, changed));
    const std::lock_guard guard(mutex_);
    if (change_ && change.fault.empty()) {
      for (Compiled& compiled : change.compiled) change_->compiled.push_back(std::move(compiled));
      change_->fault.clear();
    } else {
      change_ = std::move(change);
    }
  }
}

ShaderReload::Change ShaderReload::compile(const std::vector<std::string>& shaders) const {
  Change change;
  std::map<std::string, const gpu::ShaderCode*> embedded;
  for (const gpu::ShaderCode* shader : every_shader()) embedded[file_of(*shader)] = shader;
  for (const std::string& file : shaders) {
    auto words = compile_shader(root_, file);
    if (!words.ok()) {
      change.fault = words.error().message;
      return change;
    }
    change.compiled.push_back({embedded.at(file), std::move(*words)});
  }
  return change;
}

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <utility>

#include "engine/core/storage/sealed_file.h"
#include "modules/accuracy/module.h"

namespace gloam {
namespace {

class FileStore final : public ReferenceStore {
 public:
  explicit FileStore(std::string folder) : folder_(std::move(folder)) {}
  [[nodiscard]] std::optional<std::string> load(const std::string& identity) const override {
    return read_sealed(path_of(identity), identity);
  }
  [[nodiscard]] Status save(const std::string& identity, std::string_view bytes) const override {
    return write_sealed(path_of(identity), identity, bytes);
  }

 private:
  [[nodiscard]] std::string path_of(const std::string& identity) const {
    return folder_ + "/" + hash_text(identity) + ".kept";
  }
  const std::string folder_;
};

}  // namespace

std::unique_ptr<ReferenceStore> make_reference_store(std::string folder) {
  return std::make_unique<FileStore>(std::move(folder));
}

}  // namespace gloam

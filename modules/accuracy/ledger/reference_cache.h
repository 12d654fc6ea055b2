// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "engine/core/result.h"
#include "engine/render/reference/reference.h"

namespace gloam {

/// A reference with its own error: the difference between half and all of its samples, as in
/// LedgerRow::reference_noise; 0 if it is exact.
struct JudgedReference {
  FramePictures pictures;
  double noise = 0.0;
};

/// References that took long to compute, stored in a folder. `identity`: one line with everything the reference was
/// computed from.
class ReferenceCache {
 public:
  explicit ReferenceCache(std::string folder) : folder_(std::move(folder)) {}

  /// None if the file is absent, damaged or of another identity.
  [[nodiscard]] std::optional<JudgedReference> load(const std::string& identity) const;
  [[nodiscard]] Status save(const std::string& identity, const JudgedReference& reference) const;
  [[nodiscard]] std::string path_of(const std::string& identity) const;

 private:
  std::string folder_;
};

}  // namespace gloam

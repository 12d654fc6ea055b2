// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/result.h"
#include "engine/render/knobs/knobs.h"

namespace gloam {

/// Sets knobs temporarily: the destructor restores their values.
class KnobOverrides {
 public:
  explicit KnobOverrides(KnobRegistry& knobs) : knobs_(knobs) {}
  ~KnobOverrides();
  KnobOverrides(const KnobOverrides&) = delete;
  KnobOverrides& operator=(const KnobOverrides&) = delete;

  /// `assignments`: "KNOB=VALUE", set in order. Assignments of the current value are skipped.
  [[nodiscard]] Status set(std::span<const std::string> assignments);

 private:
  KnobRegistry& knobs_;
  std::vector<std::pair<std::string, std::string>> before_;  ///< name and previous value
};

}  // namespace gloam

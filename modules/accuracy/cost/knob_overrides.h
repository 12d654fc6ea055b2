// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
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

  /// Sets them in order. Overrides with the current value are skipped. Usage error for an unknown knob or value.
  [[nodiscard]] Status set(std::span<const KnobOverride> overrides);

 private:
  KnobRegistry& knobs_;
  std::vector<KnobOverride> before_;  ///< the previous values
};

}  // namespace gloam

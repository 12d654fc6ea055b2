// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "modules/accuracy/ledger/row_json.h"

namespace gloam {

/// The rows of one knob.
struct KnobRows {
  std::string module;  ///< that declares the knob
  /// Frames of the knob's default are frames of the user's own settings, which other knobs' frames are, too.
  bool default_is_users = true;
  std::vector<TimedRow> rows;
};

/// Gives all rows of the default one time and one memory, and every other row the default's time times its ratio. The
/// time is that of all frames of the default, whichever row they were timed beside. A knob that the user has set to
/// another value than its default has a default of its own.
void share_default_times(std::vector<KnobRows>& knobs);

}  // namespace gloam

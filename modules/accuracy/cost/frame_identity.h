// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "modules/accuracy/module.h"

namespace gloam {

/// Everything but the knobs that a drawn frame depends on, in one line; also the version of metrics and protocol.
[[nodiscard]] std::string conditions_identity(const CostRequest& request);

/// " NAME=VALUE" of all knobs but `left_out`.
[[nodiscard]] std::string knobs_identity(const KnobRegistry& knobs, std::string_view left_out = {});

/// What a stored row depends on beside its frames.
[[nodiscard]] std::string protocol_identity(const CostRequest& request);

/// The text with line breaks replaced by spaces.
[[nodiscard]] std::string joined_line(std::string text);

/// Of picture and light.
[[nodiscard]] std::string hash_of(const FramePictures& frame);

}  // namespace gloam

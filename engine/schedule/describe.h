// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>

#include "engine/schedule/system.h"

namespace gloam {

/// The systems of one stage, a line each in order of registration:
/// `view z_bins (lights): reads LightDepth, ZBinParams; writes ZBins; waits for light_bounds`.
[[nodiscard]] std::string describe_stage(std::span<const std::unique_ptr<System>> systems, Stage stage,
                                         const std::function<bool(const System&)>& runs);

}  // namespace gloam

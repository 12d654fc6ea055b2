// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "modules/accuracy/outputs.h"
#include "sandbox/options.h"
#include "sandbox/session/session.h"

namespace gloam {

/// What a ledger says of the scene, the device and the way of measuring.
[[nodiscard]] LedgerHeader ledger_header(const Session& session, const Options& options);

}  // namespace gloam

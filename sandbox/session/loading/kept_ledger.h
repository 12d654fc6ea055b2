// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "engine/core/log.h"
#include "engine/core/result.h"
#include "modules/accuracy/outputs.h"
#include "sandbox/options.h"
#include "sandbox/session/session.h"

namespace gloam {

/// The ledger beside a scene file: "scenes/courtyard.ledger.json" for "scenes/courtyard.gltf". Empty for a built-in
/// scene.
[[nodiscard]] std::string ledger_beside(const std::string& scene);

/// Keeps a ledger with combinations in the cache, for its scene and device; does nothing without a cache, or if the one
/// there is of the same program and has rows of more knobs (`--knobs` measures a few).
[[nodiscard]] Status keep_ledger(const Ledger& ledger, const Options& options);

struct LedgerFile {
  Ledger ledger;
  std::string path;
};

/// The scene's own ledger: that of --ledger (a file, or the folder that `cost` has written); else the one beside the
/// scene; else the one in the cache for this scene and device. Input error for a file of the first two kinds that is no
/// ledger or has no combinations; one of the cache is then left out with a warning.
[[nodiscard]] Result<std::optional<LedgerFile>> find_own_ledger(const Session& session, const Options& options,
                                                                LogSink& log);

/// The same, or else any ledger in the cache of this device. A usage error says how to measure one if there is none.
[[nodiscard]] Result<LedgerFile> find_ledger(const Session& session, const Options& options, LogSink& log);

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/accuracy/ledger/measurement_store.h"

#include "engine/core/storage/sealed_file.h"
#include "modules/accuracy/ledger/row_json.h"

namespace gloam {

std::string MeasurementStore::path_of(const std::string& identity) const {
  return folder_ + "/" + hash_text(identity) + ".row";
}

std::optional<TimedRow> MeasurementStore::load(const std::string& identity) const {
  const std::optional<std::string> payload = read_sealed(path_of(identity), identity);
  if (!payload) return std::nullopt;
  auto row = parse_row_json(*payload);
  if (!row) return std::nullopt;
  return std::move(row).value();
}

Status MeasurementStore::save(const std::string& identity, const TimedRow& row) const {
  return write_sealed(path_of(identity), identity, row_json(row));
}

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <charconv>
#include <cmath>

#include "modules/accuracy/outputs.h"

namespace gloam {
namespace {

/// Collects the cells of one line.
class CsvLine {
 public:
  CsvLine& text(std::string_view value) {
    if (value.find_first_of(",\"\r\n") == std::string_view::npos) return cell(value);
    std::string quoted = "\"";
    for (const char c : value) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return cell(quoted + "\"");
  }
  CsvLine& number(double value) {
    if (std::isinf(value)) return cell(value > 0 ? "inf" : "-inf");
    char buffer[32];
    return cell({buffer, std::to_chars(buffer, buffer + sizeof(buffer), value).ptr});
  }
  CsvLine& number(const std::optional<double>& value) { return value ? number(*value) : cell(""); }
  CsvLine& pair(const std::optional<ErrorPair>& value) {
    return value ? number(value->mean).number(value->p99) : cell("").cell("");
  }
  CsvLine& integer(std::uint64_t value) { return cell(std::to_string(value)); }
  CsvLine& flag(bool value) { return cell(value ? "1" : "0"); }
  [[nodiscard]] std::string finish() const { return line_ + "\n"; }

 private:
  CsvLine& cell(std::string_view value) {
    if (!first_) line_ += ',';
    first_ = false;
    line_ += value;
    return *this;
  }
  std::string line_;
  bool first_ = true;
};

constexpr const char* kCsvColumns =
    "knob,value,default,reference_kind,reference,reference_noise,below_noise,counted,counted_unit,wrong,flip_mean,flip_"
    "p99,rmse,"
    "rmse_p99,psnr_db,temporal_mean,temporal_p99,median_ms,p10_ms,p90_ms,cpu_ms,gpu_ms,module_cpu_ms,module_gpu_ms,"
    "ratio,gpu_bytes,front,ratio_low,ratio_high,pairs,wall_ms,picture,no_effect,"
    "whole_flip_mean,whole_flip_p99,whole_rmse,whole_psnr_db,edge_flip_mean,edge_flip_p99,edge_psnr_db,edge_share,"
    "effect_model,effect_model_flip_mean,effect_model_flip_p99,effect_model_rmse,effect_model_noise,camera\n";

constexpr const char* kPointColumns =
    "settings,default,exact,front,flip_mean,flip_p99,rmse,psnr_db,median_ms,p10_ms,p90_ms,wall_ms,cpu_ms,gpu_ms,ratio,"
    "ratio_low,ratio_high,pairs,gpu_bytes,predicted_ms,predicted_flip,picture,camera\n";

std::string csv_rows(const std::vector<LedgerRow>& rows, const std::string& camera) {
  std::string text;
  for (const LedgerRow& row : rows) {
    CsvLine line;
    line.text(row.knob).text(row.value).flag(row.is_default);
    line.text(row.reference_kind).text(row.reference_name).number(row.reference_noise).flag(row.below_noise);
    line.number(row.counted ? std::optional(row.counted->value) : std::nullopt);
    line.text(row.counted ? row.counted->unit : "").text(row.wrong);
    line.pair(row.flip).number(row.rmse).number(row.rmse_p99).number(row.psnr_db).pair(row.temporal);
    line.number(row.ms.median_ms).number(row.ms.p10_ms).number(row.ms.p90_ms).number(row.cpu_ms).number(row.gpu_ms);
    line.number(row.module_cpu_ms).number(row.module_gpu_ms);
    line.number(row.ratio).integer(row.gpu_bytes).flag(row.on_front);
    line.number(row.ratio_low).number(row.ratio_high).integer(row.pairs).number(row.wall_ms);
    line.text(row.picture).flag(row.no_effect);
    const auto whole = [&](double WholeError::*member) {
      return row.whole ? std::optional((*row.whole).*member) : std::nullopt;
    };
    line.pair(row.whole ? std::optional(row.whole->flip) : std::nullopt);
    line.number(whole(&WholeError::rmse)).number(whole(&WholeError::psnr_db));
    line.pair(row.edges ? std::optional(row.edges->flip) : std::nullopt);
    line.number(row.edges ? std::optional(row.edges->psnr_db) : std::nullopt);
    line.number(row.edges ? std::optional(row.edges->share) : std::nullopt);
    line.text(row.effect_model ? row.effect_model->name : "")
        .pair(row.effect_model ? std::optional(row.effect_model->flip) : std::nullopt);
    line.number(row.effect_model ? std::optional(row.effect_model->rmse) : std::nullopt);
    line.number(row.effect_model ? std::optional(row.effect_model->noise) : std::nullopt).text(camera);
    text += line.finish();
  }
  return text;
}

/// row: the point's, or that of one camera.
std::string point_line(const LedgerPoint& point, const LedgerRow& row, const std::string& camera) {
  CsvLine line;
  line.text(settings_text(point.settings)).flag(row.is_default).flag(point.is_exact).flag(row.on_front);
  line.pair(row.flip).number(row.rmse).number(row.psnr_db);
  line.number(row.ms.median_ms).number(row.ms.p10_ms).number(row.ms.p90_ms).number(row.wall_ms);
  line.number(row.cpu_ms).number(row.gpu_ms).number(row.ratio).number(row.ratio_low).number(row.ratio_high);
  line.integer(row.pairs).integer(row.gpu_bytes).number(point.predicted_ms).number(point.predicted_flip);
  line.text(row.picture).text(camera);
  return line.finish();
}

}  // namespace

std::string points_csv(const Ledger& ledger) {
  std::string text = kPointColumns;
  for (const LedgerPoint& point : ledger.points) text += point_line(point, point.measured, ledger.header.camera);
  for (std::size_t i = 0; i < ledger.cameras.size(); ++i)
    for (const LedgerPoint& point : ledger.points)
      if (i < point.cameras.size()) text += point_line(point, point.cameras[i], ledger.cameras[i].camera);
  return text;
}

std::string ledger_csv(const Ledger& ledger) {
  std::string text = kCsvColumns + csv_rows(ledger.rows, ledger.header.camera);
  for (const CameraRows& camera : ledger.cameras) text += csv_rows(camera.rows, camera.camera);
  return text;
}

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "engine/core/text/json_nesting.h"
#include "engine/core/text/plain_text.h"
#include "modules/accuracy/ledger/row_json.h"

namespace gloam {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMostFaultBytes = 300;  ///< the parser quotes what it has read last, however long it is

/// A whole number in the range of T. nlohmann::json would wrap another one, or cast it without a defined result.
template <class T>
T whole(const Json& json) {
  if (!json.is_number_unsigned() || json.get<std::uint64_t>() > std::numeric_limits<T>::max())
    throw Json::type_error::create(302, "a number is not a whole number in its range", &json);
  return json.get<T>();
}

Json pair_json(const ErrorPair& pair) { return {{"mean", pair.mean}, {"p99", pair.p99}}; }
ErrorPair pair_of(const Json& json) { return {json.at("mean").get<double>(), json.at("p99").get<double>()}; }

/// An infinite PSNR (identical pictures) is null.
Json decibels_json(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }
double decibels_of(const Json& json) {
  return json.is_null() ? std::numeric_limits<double>::infinity() : json.get<double>();
}

/// An absent error has no key.
Json errors_json(const LedgerRow& row) {
  Json json = Json::object();
  if (row.counted) json["counted"] = {{"value", row.counted->value}, {"unit", row.counted->unit}};
  if (row.counted && row.counted->p99) json["counted"]["p99"] = *row.counted->p99;
  if (row.flip) json["flip"] = pair_json(*row.flip);
  if (row.rmse) json["rmse"] = *row.rmse;
  if (row.rmse_p99) json["rmse_p99"] = *row.rmse_p99;
  if (row.psnr_db) json["psnr_db"] = decibels_json(*row.psnr_db);
  if (row.temporal) json["temporal"] = pair_json(*row.temporal);
  if (row.edges)
    json["edges"] = {{"flip", pair_json(row.edges->flip)},
                     {"psnr_db", decibels_json(row.edges->psnr_db)},
                     {"share", row.edges->share}};
  return json;
}

void read_errors(const Json& json, LedgerRow& row) {
  if (json.contains("counted")) {
    const Json& counted = json["counted"];
    row.counted = CountedError{counted.at("value").get<double>(), counted.at("unit").get<std::string>(), {}};
    if (counted.contains("p99")) row.counted->p99 = counted["p99"].get<double>();
  }
  if (json.contains("flip")) row.flip = pair_of(json["flip"]);
  if (json.contains("rmse")) row.rmse = json["rmse"].get<double>();
  if (json.contains("rmse_p99")) row.rmse_p99 = json["rmse_p99"].get<double>();
  if (json.contains("psnr_db")) row.psnr_db = decibels_of(json["psnr_db"]);
  if (json.contains("temporal")) row.temporal = pair_of(json["temporal"]);
  if (json.contains("edges")) {
    const Json& edges = json["edges"];
    row.edges = EdgeError{pair_of(edges.at("flip")), decibels_of(edges.at("psnr_db")), edges.at("share").get<double>()};
  }
}

Json whole_json(const WholeError& error) {
  return {{"flip", pair_json(error.flip)}, {"rmse", error.rmse}, {"psnr_db", decibels_json(error.psnr_db)}};
}

WholeError whole_of(const Json& json) {
  return {pair_of(json.at("flip")), json.at("rmse").get<double>(), decibels_of(json.at("psnr_db"))};
}

Json effect_model_json(const EffectModelError& error) {
  return {{"name", error.name}, {"flip", pair_json(error.flip)}, {"rmse", error.rmse}, {"noise", error.noise}};
}

EffectModelError effect_model_of(const Json& json) {
  return {json.at("name").get<std::string>(), pair_of(json.at("flip")), json.at("rmse").get<double>(),
          json.at("noise").get<double>()};
}

Json json_of(const LedgerRow& row) {
  Json json = {{"knob", row.knob}, {"value", row.value}, {"default", row.is_default}};
  json["reference"] = {{"kind", row.reference_kind}, {"name", row.reference_name}, {"noise", row.reference_noise}};
  json["no_reference"] = row.no_reference;
  json["error"] = errors_json(row);
  if (row.whole) json["whole_frame"] = whole_json(*row.whole);
  if (row.effect_model) json["effect_model"] = effect_model_json(*row.effect_model);
  json["below_noise"] = row.below_noise;
  json["wrong"] = row.wrong;
  json["ms"] = {{"median", row.ms.median_ms}, {"p10", row.ms.p10_ms}, {"p90", row.ms.p90_ms}};
  json["wall_ms"] = row.wall_ms;
  json["cpu_ms"] = row.cpu_ms;
  json["gpu_ms"] = row.gpu_ms;
  json["module_ms"] = {{"cpu", row.module_cpu_ms}, {"gpu", row.module_gpu_ms}};
  json["ratio"] = row.ratio;
  json["ratio_interval"] = {row.ratio_low, row.ratio_high};
  json["ratio_sure_interval"] = {row.sure_low, row.sure_high};
  json["pairs"] = row.pairs;
  json["gpu_bytes"] = row.gpu_bytes;
  json["picture"] = row.picture;
  json["reference_picture"] = row.reference_picture;
  json["worst"] = Json::array();
  for (const PictureArea& area : row.worst) json["worst"].push_back({area.x, area.y, area.width, area.height});
  json["no_effect"] = row.no_effect;
  json["no_effect_reason"] = row.no_effect_reason;
  json["front"] = row.on_front;
  return json;
}

LedgerRow row_of(const Json& json) {
  LedgerRow row;
  row.knob = json.at("knob").get<std::string>();
  row.value = json.at("value").get<std::string>();
  row.is_default = json.at("default").get<bool>();
  const Json& reference = json.at("reference");
  row.reference_kind = reference.at("kind").get<std::string>();
  row.reference_name = reference.at("name").get<std::string>();
  row.reference_noise = reference.at("noise").get<double>();
  read_errors(json.at("error"), row);
  // Ledgers of earlier versions call it `whole`.
  if (json.contains("whole_frame") || json.contains("whole"))
    row.whole = whole_of(json.contains("whole_frame") ? json["whole_frame"] : json["whole"]);
  if (json.contains("effect_model")) row.effect_model = effect_model_of(json["effect_model"]);
  row.below_noise = json.at("below_noise").get<bool>();
  row.wrong = json.at("wrong").get<std::string>();
  const Json& ms = json.at("ms");
  row.ms = {ms.at("median").get<double>(), ms.at("p10").get<double>(), ms.at("p90").get<double>()};
  row.wall_ms = json.value("wall_ms", 0.0);
  row.cpu_ms = json.at("cpu_ms").get<double>();
  row.gpu_ms = json.at("gpu_ms").get<double>();
  row.module_cpu_ms = json.at("module_ms").at("cpu").get<double>();
  row.module_gpu_ms = json.at("module_ms").at("gpu").get<double>();
  row.ratio = json.at("ratio").get<double>();
  // Ledgers of older programs have no intervals.
  const Json point = {row.ratio, row.ratio};
  const Json interval = json.value("ratio_interval", point), sure = json.value("ratio_sure_interval", point);
  row.ratio_low = interval.at(0).get<double>();
  row.ratio_high = interval.at(1).get<double>();
  row.sure_low = sure.at(0).get<double>();
  row.sure_high = sure.at(1).get<double>();
  row.pairs = json.contains("pairs") ? whole<std::uint32_t>(json["pairs"]) : 0;
  row.gpu_bytes = whole<std::uint64_t>(json.at("gpu_bytes"));
  row.picture = json.value("picture", std::string());
  row.reference_picture = json.value("reference_picture", "");  // absent in ledgers of earlier versions, as is `worst`
  for (const Json& area : json.value("worst", Json::array()))
    row.worst.push_back({whole<std::uint32_t>(area.at(0)), whole<std::uint32_t>(area.at(1)),
                         whole<std::uint32_t>(area.at(2)), whole<std::uint32_t>(area.at(3))});
  row.no_effect = json.value("no_effect", false);
  row.no_reference = json.value("no_reference", "");
  row.no_effect_reason = json.value("no_effect_reason", "");
  row.on_front = json.at("front").get<bool>();
  return row;
}

/// The row of a point: it has no knob, and its error is that against the whole frame.
Json point_row_json(const LedgerRow& measured) {
  const Json row = json_of(measured);
  Json json = Json::object();
  json["error"] = errors_json(measured);
  const double ms = measured.ratio > 0.0 ? measured.ms.median_ms / measured.ratio : 0.0;
  json["interval"] = {ms * measured.ratio_low, ms * measured.ratio_high};  // of the median, ms
  for (const char* key :
       {"default", "whole_frame", "ms", "wall_ms", "cpu_ms", "gpu_ms", "ratio", "ratio_interval", "ratio_sure_interval",
        "pairs", "gpu_bytes", "picture", "reference_picture", "worst", "front"})
    json[key] = row.at(key);
  return json;
}

LedgerRow point_row_of(const Json& json, const std::vector<KnobValue>& settings) {
  Json row = json;
  row.update({{"knob", ""}, {"value", settings_text(settings)}, {"below_noise", false}, {"wrong", ""}});
  row["reference"] = {{"kind", kWholeFrameKind}, {"name", kWholeFrameName}, {"noise", 0.0}};
  if (!json.contains("error")) row["error"] = json.at("whole");  // earlier versions
  row["module_ms"] = {{"cpu", 0.0}, {"gpu", 0.0}};
  // Every point has these errors: readers of a ledger choose by them.
  static_cast<void>(row.at("error").at("flip"));
  static_cast<void>(row.at(row.contains("whole") ? "whole" : "whole_frame"));
  return row_of(row);
}

Json json_of(const LedgerPoint& point) {
  Json json = point_row_json(point.measured);
  json["settings"] = Json::object();
  for (const KnobValue& setting : point.settings) json["settings"][setting.knob] = setting.value;
  json["exact"] = point.is_exact;
  json["predicted"] = {{"ms", point.predicted_ms}, {"error", point.predicted_flip}};
  for (const LedgerRow& camera : point.cameras) json["cameras"].push_back(point_row_json(camera));
  return json;
}

LedgerPoint point_of(const Json& json) {
  LedgerPoint point = {.is_exact = json.at("exact").get<bool>()};
  for (const auto& [knob, value] : json.at("settings").items())
    point.settings.push_back({knob, value.get<std::string>()});
  point.predicted_ms = json.at("predicted").at("ms").get<double>();
  const Json& predicted = json.at("predicted");
  point.predicted_flip = predicted.value("error", predicted.value("flip", 0.0));
  point.measured = point_row_of(json, point.settings);
  for (const Json& camera : json.value("cameras", Json::array()))
    point.cameras.push_back(point_row_of(camera, point.settings));
  return point;
}

Json json_of(const ModelQuality& model) {
  const auto ratio = [](const ModelRatio& value) { return Json{{"median", value.median}, {"worst", value.worst}}; };
  return {{"points", model.points}, {"time", ratio(model.time)}, {"error", ratio(model.error)}};
}

ModelQuality model_of(const Json& json) {
  const auto ratio = [](const Json& value) {
    return ModelRatio{value.at("median").get<double>(), value.at("worst").get<double>()};
  };
  return {whole<std::uint32_t>(json.at("points")), ratio(json.at("time")), ratio(json.at("error"))};
}

Json json_of(const FrameCost& frame) {
  Json modules = Json::array();
  for (const ModuleCost& cost : frame.modules) modules.push_back({cost.module, cost.cpu_ms, cost.gpu_ms});
  return {{"ms", {frame.cpu_ms, frame.gpu_ms, frame.processor_ms}}, {"modules", std::move(modules)}};
}

FrameCost frame_of(const Json& json) {
  const Json& ms = json.at("ms");
  FrameCost frame = {ms.at(0).get<double>(), ms.at(1).get<double>(), ms.at(2).get<double>(), {}};
  for (const Json& cost : json.at("modules"))
    frame.modules.push_back({cost.at(0).get<std::string>(), cost.at(1).get<double>(), cost.at(2).get<double>()});
  return frame;
}

Json json_of(const LedgerHeader& header) {
  Json json = {{"version", 1}, {"scene", header.scene}, {"scene_hash", header.scene_hash}, {"camera", header.camera}};
  json["time_s"] = header.time_s;
  json["device"] = {{"name", header.device},
                    {"driver", header.driver},
                    {"type", header.device_type},
                    {"subgroup_size", header.subgroup_size}};
  json["host"] = header.host;
  json["size"] = {header.width, header.height};
  json["gloam"] = {{"version", header.version}, {"build", header.build}};
  json["quick"] = header.quick;
  json["frames"] = header.frames;
  if (header.seconds > 0.0) json["seconds"] = header.seconds;
  json["clock"] = header.device_type == "cpu" ? "processor" : "gpu";
  json["clock_meaning"] = header.clock;
  json["reference_samples"] = header.samples;
  return json;
}

LedgerHeader header_of(const Json& json) {
  LedgerHeader header;
  header.scene = json.at("scene").get<std::string>();
  header.scene_hash = json.at("scene_hash").get<std::string>();
  header.camera = json.at("camera").get<std::string>();
  header.time_s = json.at("time_s").get<double>();
  const Json& device = json.at("device");
  header.device = device.at("name").get<std::string>();
  header.driver = device.at("driver").get<std::string>();
  header.device_type = device.at("type").get<std::string>();
  header.subgroup_size = whole<std::uint32_t>(device.at("subgroup_size"));
  header.width = whole<std::uint32_t>(json.at("size").at(0));
  header.height = whole<std::uint32_t>(json.at("size").at(1));
  header.version = json.at("gloam").at("version").get<std::string>();
  header.build = json.at("gloam").at("build").get<std::string>();
  header.host = json.value("host", std::string());
  header.quick = json.at("quick").get<bool>();
  header.frames = whole<std::uint32_t>(json.at("frames"));
  header.seconds = json.value("seconds", 0.0);
  header.clock = json.value("clock_meaning", std::string());
  header.samples = whole<std::uint32_t>(json.at("reference_samples"));
  return header;
}

/// Returns `read(json)`, or an error that names the fault in the text. `what`: names the text in the message.
template <class Read>
auto parse(std::string_view text, const char* what, Read&& read) -> Result<decltype(read(Json()))> {
  const auto fault_of = [what](std::string_view fault) {
    return Error{ErrorKind::input, std::string("is no ") + what + ": " + one_line(fault, kMostFaultBytes)};
  };
  if (nests_too_deep(text)) return fault_of("it " + too_deep_text());
  try {
    return read(Json::parse(text));
  } catch (const Json::exception& fault) {
    return fault_of(fault.what());
  }
}

std::string dump(const Json& json, int indent) { return json.dump(indent, ' ', false, Json::error_handler_t::replace); }

}  // namespace

std::string row_json(const TimedRow& measured) {
  Json json = {{"row", json_of(measured.row)}, {"default_frames", Json::array()}};
  for (const FrameCost& frame : measured.standard) json["default_frames"].push_back(json_of(frame));
  return dump(json, -1);
}

Result<TimedRow> parse_row_json(std::string_view text) {
  return parse(text, "row of a ledger", [](const Json& json) {
    TimedRow measured = {.row = row_of(json.at("row"))};
    for (const Json& frame : json.at("default_frames")) measured.standard.push_back(frame_of(frame));
    return measured;
  });
}

std::string ledger_json(const Ledger& ledger) {
  Json json = json_of(ledger.header);
  json["rows"] = Json::array();
  for (const LedgerRow& row : ledger.rows) json["rows"].push_back(json_of(row));
  json["skipped"] = Json::array();
  for (const SkippedKnob& skipped : ledger.skipped)
    json["skipped"].push_back({{"knob", skipped.knob}, {"reason", skipped.reason}});
  for (const CameraRows& camera : ledger.cameras) {
    Json rows = Json::array();
    for (const LedgerRow& row : camera.rows) rows.push_back(json_of(row));
    json["cameras"].push_back({{"camera", camera.camera}, {"time_s", camera.time_s}, {"rows", std::move(rows)}});
  }
  json["points"] = Json::array();
  for (const LedgerPoint& point : ledger.points) json["points"].push_back(json_of(point));
  if (ledger.model) json["model"] = json_of(*ledger.model);
  return dump(json, 2) + "\n";
}

Result<Ledger> parse_ledger_json(std::string_view text) {
  auto parsed = parse(text, "ledger", [](const Json& json) -> std::optional<Ledger> {
    if (whole<std::uint32_t>(json.at("version")) != 1) return std::nullopt;
    Ledger ledger = {.header = header_of(json)};
    for (const Json& row : json.at("rows")) ledger.rows.push_back(row_of(row));
    for (const Json& skipped : json.at("skipped"))
      ledger.skipped.push_back({skipped.at("knob").get<std::string>(), skipped.at("reason").get<std::string>()});
    for (const Json& json_camera : json.value("cameras", Json::array())) {
      CameraRows& camera = ledger.cameras.emplace_back();
      camera.camera = json_camera.at("camera").get<std::string>();
      camera.time_s = json_camera.at("time_s").get<double>();
      for (const Json& row : json_camera.at("rows")) camera.rows.push_back(row_of(row));
    }
    for (const Json& point : json.value("points", Json::array())) ledger.points.push_back(point_of(point));
    if (json.contains("model")) ledger.model = model_of(json["model"]);
    return ledger;
  });
  if (!parsed) return parsed.error();
  if (!*parsed) return Error{ErrorKind::input, "is a ledger of another version; this program reads version 1"};
  return std::move(**parsed);
}

}  // namespace gloam

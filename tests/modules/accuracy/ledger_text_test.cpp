// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "modules/accuracy/ledger/row_json.h"
#include "modules/accuracy/outputs.h"
#include "tests/modules/accuracy/ledger_rows.h"

namespace gloam {
namespace {

using test::bare_row;
using test::full_ledger;
using test::measured;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(ledger_json, reads_back_what_it_wrote) {
  const Ledger ledger = full_ledger();
  const auto read = parse_ledger_json(ledger_json(ledger));
  ASSERT_TRUE(read.ok()) << read.error().message;
  EXPECT_EQ(read->header, ledger.header);
  EXPECT_EQ(read->rows, ledger.rows);
  EXPECT_EQ(read->skipped, ledger.skipped);
  EXPECT_EQ(read->points, ledger.points);
  EXPECT_EQ(read->model, ledger.model);
}

TEST(ledger_json, reads_back_rows_one_by_one) {
  for (std::uint32_t seed = 1; seed < 50; ++seed) {
    const auto read = parse_row_json(row_json(measured(seed)));
    ASSERT_TRUE(read.ok()) << read.error().message;
    EXPECT_EQ(*read, measured(seed));
  }
  EXPECT_EQ(parse_row_json(row_json({.row = bare_row(), .standard = {}}))->row, bare_row());
  EXPECT_THAT(row_json(measured()), Not(HasSubstr("\n")));
}

TEST(ledger_json, has_what_scripts_look_for) {
  const auto json = nlohmann::json::parse(ledger_json(full_ledger()));
  EXPECT_EQ(json["version"], 1);
  EXPECT_EQ(json["size"], nlohmann::json::array({320, 180}));
  EXPECT_EQ(json["quick"], true);
  EXPECT_EQ(json["device"]["driver"], "a driver, 1.2");
  EXPECT_EQ(json["rows"][0]["reference"]["kind"], "traced");
  EXPECT_TRUE(json["rows"][4]["error"]["psnr_db"].is_null()) << "the same picture has no finite ratio";
  EXPECT_TRUE(json["rows"][5]["error"].empty()) << "no reference, no errors";
  EXPECT_TRUE(json["rows"][0]["whole_frame"]["flip"]["p99"].is_number());
  EXPECT_EQ(json["points"][0]["settings"]["shadows.filter"], "hard");
  EXPECT_TRUE(json["points"][0]["whole_frame"]["rmse"].is_number());
  EXPECT_EQ(json["clock"], "processor");
  EXPECT_TRUE(json["rows"][0]["ratio_interval"][1].is_number());
  EXPECT_TRUE(json["rows"][0]["no_effect"].is_boolean());
  for (const auto& point : json["points"]) {
    EXPECT_TRUE(point["predicted"]["ms"].is_number() && point["predicted"]["error"].is_number());
    EXPECT_TRUE(point["error"]["flip"]["mean"].is_number() && point["front"].is_boolean());
    for (const char* name : {"median", "p10", "p90"}) EXPECT_TRUE(point["ms"][name].is_number());
  }
  const LedgerRow& row = full_ledger().points[0].measured;
  EXPECT_NEAR(json["points"][0]["interval"][0], row.ms.median_ms * row.ratio_low / row.ratio, 1e-9);
  EXPECT_NEAR(json["points"][0]["interval"][1], row.ms.median_ms * row.ratio_high / row.ratio, 1e-9);
  EXPECT_EQ(json["model"]["time"]["worst"], 0.5);
}

TEST(ledger_json, says_what_is_wrong_with_a_text) {
  for (const std::string text : {"", "{", "[]", "3", "{}", R"({"version": 1})", R"({"version": 1, "scene": 7})"}) {
    const auto read = parse_ledger_json(text);
    ASSERT_FALSE(read.ok()) << text;
    EXPECT_EQ(read.error().kind, ErrorKind::input);
    EXPECT_THAT(read.error().message, HasSubstr("is no ledger"));
  }
  EXPECT_THAT(parse_ledger_json(R"({"version": 2})").error().message, HasSubstr("another version"));
  EXPECT_FALSE(parse_row_json("{}").ok());
}

TEST(ledger_json, refuses_hostile_texts_in_one_short_line) {
  const std::string deep = R"({"version": 1, "cameras": )" + std::string(200000, '[') + std::string(200000, ']') + "}";
  EXPECT_THAT(parse_ledger_json(deep).error().message, HasSubstr("nested deeper than 96 levels"));
  const std::string open = "{\"a\": \"\n" + std::string(100000, 'x');  // a string that is not closed
  EXPECT_LT(parse_ledger_json(open).error().message.size(), 400u);
  EXPECT_EQ(parse_ledger_json(open).error().message.find('\n'), std::string::npos);
}

TEST(ledger_json, refuses_numbers_that_are_not_whole_or_out_of_range) {
  for (const char* number : {"1e30", "-1", "0.5", "4294967296"}) {
    auto json = nlohmann::json::parse(ledger_json(full_ledger()));
    json["rows"][0]["pairs"] = nlohmann::json::parse(number);
    EXPECT_THAT(parse_ledger_json(json.dump()).error().message, HasSubstr("not a whole number")) << number;
  }
}

TEST(ledger_json, refuses_a_point_without_the_errors_that_choose_it) {
  const auto sound = nlohmann::json::parse(ledger_json(full_ledger()));
  auto json = sound;
  json["points"][0].erase("whole_frame");
  EXPECT_THAT(parse_ledger_json(json.dump()).error().message, HasSubstr("whole_frame"));
  json = sound;
  json["points"][0]["error"].erase("flip");
  EXPECT_THAT(parse_ledger_json(json.dump()).error().message, HasSubstr("flip"));
}

TEST(ledger_json, reads_ledgers_of_the_same_version_without_later_keys) {
  auto json = nlohmann::json::parse(ledger_json(full_ledger()));
  json.erase("clock_meaning");
  json.erase("points");
  json.erase("model");
  for (auto& row : json["rows"])
    for (const char* later : {"wall_ms", "ratio_interval", "ratio_sure_interval", "pairs", "picture", "no_effect",
                              "whole_frame", "effect_model"})
      row.erase(later);
  for (auto& row : json["rows"]) row["error"].erase("edges");
  const auto read = parse_ledger_json(json.dump());
  ASSERT_TRUE(read.ok()) << read.error().message;
  EXPECT_TRUE(read->points.empty() && !read->model && !read->rows[0].whole && !read->rows[0].edges &&
              !read->rows[0].effect_model);
  EXPECT_EQ(read->rows[0].ratio, full_ledger().rows[0].ratio);
  EXPECT_EQ(read->rows[0].ratio_high, read->rows[0].ratio) << "an interval of one point";
}

TEST(ledger_json, reads_the_keys_of_earlier_versions) {
  auto json = nlohmann::json::parse(ledger_json(full_ledger()));
  for (auto& row : json["rows"])
    if (row.contains("whole_frame")) row["whole"] = row["whole_frame"], row.erase("whole_frame");
  for (auto& point : json["points"]) {
    point["whole"] = point["whole_frame"];
    point["predicted"]["flip"] = point["predicted"]["error"];
    point["predicted"].erase("error");
    point.erase("whole_frame");
    point.erase("error");
    point.erase("interval");
  }
  const auto read = parse_ledger_json(json.dump());
  ASSERT_TRUE(read.ok()) << read.error().message;
  EXPECT_EQ(read->rows, full_ledger().rows);
  EXPECT_EQ(read->points, full_ledger().points);
}

TEST(ledger_json, survives_cutting_at_every_byte) {
  const std::string text = row_json(measured());
  for (std::size_t size = 0; size < text.size(); ++size)
    EXPECT_FALSE(parse_row_json(text.substr(0, size)).ok()) << size;
}

/// Cells of RFC 4180 text, line by line.
std::vector<std::vector<std::string>> csv_cells(const std::string& text) {
  std::vector<std::vector<std::string>> lines(1, std::vector<std::string>(1));
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    std::string& cell = lines.back().back();
    if (quoted && c == '"' && i + 1 < text.size() && text[i + 1] == '"') {
      cell += c;
      ++i;
    } else if (c == '"') {
      quoted = !quoted;
    } else if (!quoted && c == ',') {
      lines.back().emplace_back();
    } else if (!quoted && c == '\n') {
      lines.emplace_back(1);
    } else {
      cell += c;
    }
  }
  lines.pop_back();
  return lines;
}

TEST(ledger_csv, reads_back_what_it_wrote) {
  const Ledger ledger = full_ledger();
  const auto lines = csv_cells(ledger_csv(ledger));
  ASSERT_EQ(lines.size(), ledger.rows.size() + 1);
  const auto& names = lines[0];
  for (std::size_t i = 0; i < ledger.rows.size(); ++i) {
    const LedgerRow& row = ledger.rows[i];
    ASSERT_EQ(lines[i + 1].size(), names.size());
    const auto cell = [&](const std::string& name) {
      const auto found = std::find(names.begin(), names.end(), name);
      return found == names.end() ? "no column " + name : lines[i + 1][static_cast<std::size_t>(found - names.begin())];
    };
    const auto expect_number = [&](const std::string& name, const std::optional<double>& value) {
      EXPECT_EQ(cell(name).empty(), !value) << name;
      EXPECT_EQ(std::strtod(cell(name).c_str(), nullptr), value.value_or(0.0)) << name;
    };
    EXPECT_EQ(cell("knob"), row.knob);
    EXPECT_EQ(cell("value"), row.value);
    EXPECT_EQ(cell("default"), row.is_default ? "1" : "0");
    EXPECT_EQ(cell("reference_kind"), row.reference_kind);
    EXPECT_EQ(cell("reference"), row.reference_name);
    EXPECT_EQ(cell("below_noise"), row.below_noise ? "1" : "0");
    EXPECT_EQ(cell("front"), row.on_front ? "1" : "0");
    EXPECT_EQ(cell("gpu_bytes"), std::to_string(row.gpu_bytes));
    EXPECT_EQ(cell("counted_unit"), row.counted ? row.counted->unit : "");
    EXPECT_EQ(cell("wrong"), row.wrong);
    expect_number("counted", row.counted ? std::optional(row.counted->value) : std::nullopt);
    expect_number("reference_noise", row.reference_noise);
    expect_number("flip_mean", row.flip ? std::optional(row.flip->mean) : std::nullopt);
    expect_number("flip_p99", row.flip ? std::optional(row.flip->p99) : std::nullopt);
    expect_number("rmse", row.rmse);
    expect_number("rmse_p99", row.rmse_p99);
    expect_number("psnr_db", row.psnr_db);
    expect_number("temporal_mean", row.temporal ? std::optional(row.temporal->mean) : std::nullopt);
    expect_number("temporal_p99", row.temporal ? std::optional(row.temporal->p99) : std::nullopt);
    expect_number("median_ms", row.ms.median_ms);
    expect_number("p10_ms", row.ms.p10_ms);
    expect_number("p90_ms", row.ms.p90_ms);
    expect_number("cpu_ms", row.cpu_ms);
    expect_number("gpu_ms", row.gpu_ms);
    expect_number("module_cpu_ms", row.module_cpu_ms);
    expect_number("module_gpu_ms", row.module_gpu_ms);
    expect_number("ratio", row.ratio);
    expect_number("ratio_low", row.ratio_low);
    expect_number("ratio_high", row.ratio_high);
    expect_number("wall_ms", row.wall_ms);
    EXPECT_EQ(cell("pairs"), std::to_string(row.pairs));
    EXPECT_EQ(cell("picture"), row.picture);
    EXPECT_EQ(cell("no_effect"), row.no_effect ? "1" : "0");
    expect_number("whole_flip_mean", row.whole ? std::optional(row.whole->flip.mean) : std::nullopt);
    expect_number("whole_flip_p99", row.whole ? std::optional(row.whole->flip.p99) : std::nullopt);
    expect_number("whole_rmse", row.whole ? std::optional(row.whole->rmse) : std::nullopt);
    expect_number("whole_psnr_db", row.whole ? std::optional(row.whole->psnr_db) : std::nullopt);
    expect_number("edge_flip_mean", row.edges ? std::optional(row.edges->flip.mean) : std::nullopt);
    expect_number("edge_flip_p99", row.edges ? std::optional(row.edges->flip.p99) : std::nullopt);
    expect_number("edge_psnr_db", row.edges ? std::optional(row.edges->psnr_db) : std::nullopt);
    expect_number("edge_share", row.edges ? std::optional(row.edges->share) : std::nullopt);
    const auto& model = row.effect_model;
    EXPECT_EQ(cell("effect_model"), model ? model->name : "");
    expect_number("effect_model_flip_mean", model ? std::optional(model->flip.mean) : std::nullopt);
    expect_number("effect_model_flip_p99", model ? std::optional(model->flip.p99) : std::nullopt);
    expect_number("effect_model_rmse", model ? std::optional(model->rmse) : std::nullopt);
    expect_number("effect_model_noise", model ? std::optional(model->noise) : std::nullopt);
  }
}

TEST(points_csv, has_a_line_a_point) {
  const Ledger ledger = full_ledger();
  const auto lines = csv_cells(points_csv(ledger));
  ASSERT_EQ(lines.size(), ledger.points.size() + 1);
  for (std::size_t i = 0; i < ledger.points.size(); ++i) {
    ASSERT_EQ(lines[i + 1].size(), lines[0].size());
    const auto cell = [&](const std::string& name) {
      const auto found = std::ranges::find(lines[0], name);
      return found == lines[0].end() ? "no column " + name
                                     : lines[i + 1][static_cast<std::size_t>(found - lines[0].begin())];
    };
    const LedgerPoint& point = ledger.points[i];
    EXPECT_EQ(cell("settings"), settings_text(point.settings));
    EXPECT_EQ(cell("exact"), point.is_exact ? "1" : "0");
    EXPECT_EQ(cell("default"), point.measured.is_default ? "1" : "0");
    EXPECT_EQ(cell("front"), point.measured.on_front ? "1" : "0");
    EXPECT_EQ(std::strtod(cell("flip_mean").c_str(), nullptr), point.measured.flip->mean);
    EXPECT_EQ(std::strtod(cell("median_ms").c_str(), nullptr), point.measured.ms.median_ms);
    EXPECT_EQ(std::strtod(cell("ratio_high").c_str(), nullptr), point.measured.ratio_high);
    EXPECT_EQ(std::strtod(cell("predicted_ms").c_str(), nullptr), point.predicted_ms);
    EXPECT_EQ(std::strtod(cell("predicted_flip").c_str(), nullptr), point.predicted_flip);
    EXPECT_EQ(cell("picture"), point.measured.picture);
  }
}

TEST(points_csv, has_the_points_of_each_camera_after_the_worst) {
  const Ledger ledger = test::ledger_of_two_cameras();
  const auto lines = csv_cells(points_csv(ledger));
  const std::size_t points = ledger.points.size();
  ASSERT_EQ(lines.size(), 3 * points + 1);
  EXPECT_EQ(lines[0].back(), "camera");
  for (std::size_t i = 0; i < points; ++i) {
    EXPECT_EQ(lines[1 + i].back(), "lawn,pond");
    EXPECT_EQ(lines[1 + points + i].back(), "lawn");
    EXPECT_EQ(lines[1 + 2 * points + i].back(), "pond");
    EXPECT_EQ(lines[1 + 2 * points + i][lines[0].size() - 2], "of the pond");
    EXPECT_EQ(lines[1 + 2 * points + i][0], lines[1 + i][0]);
  }
}

TEST(ledger_json, keeps_the_points_of_each_camera) {
  const Ledger ledger = test::ledger_of_two_cameras();
  const auto read = parse_ledger_json(ledger_json(ledger));
  ASSERT_TRUE(read.ok()) << read.error().message;
  EXPECT_EQ(read->points, ledger.points);
  EXPECT_EQ(read->cameras, ledger.cameras);
}

TEST(settings_text, are_assignments_and_a_config) {
  const std::vector<KnobValue> settings = {{"a.b", "c"}, {"d.e", "\"0.5\""}};
  EXPECT_EQ(settings_text(settings), "a.b=c d.e=\"0.5\"");
  EXPECT_EQ(settings_text({}), "default");
  EXPECT_EQ(settings_config(settings), "{\n  \"a.b\": \"c\",\n  \"d.e\": \"\\\"0.5\\\"\"\n}\n");
  EXPECT_EQ(settings_config({}), "{}\n");
}

TEST(ledger_table, has_a_line_a_row_and_marks_the_front) {
  Ledger ledger = full_ledger();
  const std::string table = ledger_table(ledger);
  EXPECT_THAT(table, HasSubstr("320x180, camera lawn, time 0.1 s"));
  EXPECT_THAT(table, HasSubstr("a device, a driver, 1.2; gloam 0.1.0 (fedcba9876543210)"));
  EXPECT_THAT(table, HasSubstr("\n*  shadows.filter"));
  EXPECT_THAT(table, HasSubstr("filmic (default)"));
  EXPECT_THAT(table, HasSubstr("< noise"));
  EXPECT_THAT(table, HasSubstr("lighting.tone_map: no reference"));
  EXPECT_THAT(table, HasSubstr("grass.lod: not measured: the scene does not call for grass"));
  EXPECT_THAT(table, HasSubstr("quick: 320x180, at most 5 frames a value, 64 reference samples"));
  ledger.header.quick = false;
  EXPECT_THAT(ledger_table(ledger), Not(HasSubstr("quick")));
}

TEST(ledger_table, tells_what_was_counted_and_what_is_wrong) {
  LedgerRow row = bare_row();
  row.reference_kind = "brute force";
  row.reference_name = "exact lists";
  row.flip = ErrorPair{};
  Ledger ledger = {.rows = {row}};
  EXPECT_THAT(ledger_table(ledger), Not(HasSubstr("counted"))) << "no row counts anything";
  row.counted = CountedError{12.3456, "false positives a tile"};
  row.on_front = true;
  ledger.rows.push_back(row);
  row.value = "fast";
  row.wrong = "3 lights missing";
  ledger.rows.push_back(row);
  const std::string table = ledger_table(ledger);
  EXPECT_THAT(table, HasSubstr("value             counted  FLIP mean"));
  EXPECT_THAT(table, HasSubstr("*  lighting.tone_map  filmic (default)   12.346   0.000000"));
  EXPECT_THAT(table, HasSubstr("!  lighting.tone_map  fast"));
  EXPECT_THAT(table, HasSubstr("brute force, exact lists; counted: false positives a tile\n"));
  EXPECT_THAT(table, HasSubstr("! lighting.tone_map=fast is wrong: 3 lights missing\n"));
}

TEST(ledger_table, shows_the_error_at_edges_if_a_row_has_one) {
  LedgerRow row = bare_row();
  row.flip = ErrorPair{0.01, 0.1};
  EXPECT_THAT(ledger_table({.rows = {row}}), Not(HasSubstr("at edges  ")));
  row.edges = EdgeError{{0.25, 0.5}, 20.0, 0.04};
  const std::string table = ledger_table({.rows = {row}});
  EXPECT_THAT(table, HasSubstr("FLIP p99  at edges"));
  EXPECT_THAT(table, HasSubstr("0.100000  0.250000"));
}

TEST(ledger_table, tells_how_far_the_default_s_frame_is_from_what_the_effect_s_model_approximates) {
  LedgerRow row = bare_row();
  row.is_default = true;
  row.flip = ErrorPair{0.01, 0.1};
  EXPECT_THAT(ledger_table({.rows = {row}}), Not(HasSubstr("the effect's model")));
  row.effect_model = EffectModelError{"marched rays", {0.25, 0.5}, 2.5, 0.001};
  const std::string line =
      row.knob + "=" + row.value +
      ": the effect's model differs by mean FLIP 0.250000 (noise 0.001000), RMSE 2.5 cd/m² from marched rays\n";
  EXPECT_THAT(ledger_table({.rows = {row}}), HasSubstr(line));
  row.is_default = false;
  EXPECT_THAT(ledger_table({.rows = {row}}), Not(HasSubstr("the effect's model")));
}

TEST(ledger_table, of_nothing_is_a_head) { EXPECT_THAT(ledger_table({}), HasSubstr("knob")); }

}  // namespace
}  // namespace gloam

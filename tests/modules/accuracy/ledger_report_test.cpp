// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "modules/accuracy/module.h"
#include "modules/accuracy/report/html_text.h"
#include "modules/accuracy/report/report_data.h"
#include "tests/modules/accuracy/ledger_rows.h"

namespace gloam {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;

LedgerRow value_row(const std::string& knob, const std::string& value, double ratio, double flip) {
  LedgerRow row = {.knob = knob, .value = value, .is_default = ratio == 1.0, .reference_kind = "traced"};
  row.reference_name = "visibility";
  row.flip = ErrorPair{flip, 2.0 * flip};
  row.ratio = ratio;
  row.ratio_low = row.is_default ? 1.0 : 0.98 * ratio;
  row.ratio_high = row.is_default ? 1.0 : 1.02 * ratio;
  row.ms.median_ms = 20.0 * ratio;
  row.picture = knob + value;
  return row;
}

Ledger ledger_of(std::vector<LedgerRow> rows) {
  Ledger ledger = test::full_ledger();
  ledger.skipped.clear();
  ledger.points.clear();
  ledger.model.reset();
  ledger.rows = std::move(rows);
  return ledger;
}

LedgerPoint point_at(double ms, double flip, std::vector<KnobValue> settings) {
  LedgerPoint point = {.settings = std::move(settings)};
  LedgerRow& row = point.measured;
  row.value = settings_text(point.settings);
  row.is_default = point.settings.empty();
  row.reference_kind = kWholeFrameKind;
  row.reference_name = kWholeFrameName;
  row.flip = ErrorPair{flip, flip};
  row.ms.median_ms = ms;
  row.ratio = ms / 40.0;
  row.ratio_low = row.is_default ? 1.0 : 0.98 * row.ratio;
  row.ratio_high = row.is_default ? 1.0 : 1.02 * row.ratio;
  row.picture = row.value;
  row.reference_picture = "whole";
  row.on_front = true;
  return point;
}

/// 12 ms, the default at 40 ms, and the exact setting at 90 ms.
Ledger ledger_with_points() {
  Ledger ledger =
      ledger_of({value_row("shadows.filter", "hard", 0.5, 0.05), value_row("shadows.filter", "chs", 1.0, 0.005)});
  ledger.points = {point_at(12.0, 0.05, {{"shadows.filter", "hard"}}), point_at(40.0, 0.005, {}),
                   point_at(90.0, 0.0, {{"lights.culling", "brute"}})};
  ledger.points.back().is_exact = true;
  ledger.model = ModelQuality{1, {1.25, 0.5}, {0.75, 3.5}};
  return ledger;
}

std::size_t count_of(std::string_view text, std::string_view part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string_view::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

TEST(HtmlText, escapes_everything_that_ends_text_or_attributes) {
  EXPECT_EQ(escaped("a<b>&\"c'\n"), "a&lt;b&gt;&amp;&quot;c&#39;\n");
  EXPECT_EQ(escaped(std::string_view("\0\x1b", 2)), "\xEF\xBF\xBD\xEF\xBF\xBD");
  EXPECT_EQ(escaped("m² – ü"), "m² – ü");
}

TEST(HtmlText, base64_is_that_of_the_standard) {
  // Section 10 of RFC 4648.
  const std::pair<std::string_view, std::string_view> vectors[] = {
      {"", ""}, {"f", "Zg=="}, {"fo", "Zm8="}, {"foo", "Zm9v"}, {"foob", "Zm9vYg=="}, {"fooba", "Zm9vYmE="}};
  for (const auto& [bytes, text] : vectors) EXPECT_EQ(base64(bytes), text);
  EXPECT_EQ(base64("\xff\xff\xfe"), "///+");
}

TEST(HtmlText, numbers_are_short) {
  EXPECT_EQ(number_text(0.0), "0");
  EXPECT_EQ(number_text(0.01234), "0.0123");
  EXPECT_EQ(number_text(12.34), "12.3");
  EXPECT_EQ(number_text(123.4), "123");
  EXPECT_EQ(number_text(4.2e-6), "4.2e-06");
  EXPECT_EQ(ratio_text(value_row("a.b", "c", 0.71, 0.0)), "0.71 (0.70–0.72)");
  LedgerRow row = value_row("a.b", "c", 0.97, 0.0);
  row.ratio_high = 0.9985;
  EXPECT_EQ(ratio_text(row), "0.970 (0.951–0.999)") << "an interval that ends below 1 does not read as 1";
}

TEST(HtmlText, words_of_a_small_mean_tell_of_bad_places) {
  EXPECT_EQ(visibility_words({0.005, 0.05}), "nobody sees it side by side");
  EXPECT_EQ(visibility_words({0.005, 0.2}), "seen only at its worst places");
  EXPECT_EQ(visibility_words({0.02, 0.2}), "seen at most when flipping between the pictures");
  EXPECT_EQ(visibility_words({0.2, 0.2}), "seen at once");
  LedgerRow row = value_row("a.b", "c", 0.5, 0.005);
  EXPECT_EQ(error_words(row), "nobody sees it side by side (error 0.00500 FLIP, p99 0.0100)");
  row.flip = ErrorPair{};
  EXPECT_EQ(error_words(row), "equal to the reference (error 0)");
}

TEST(HtmlText, names_a_reference_once) {
  LedgerRow row = {.reference_kind = "traced", .reference_name = "reflections, traced"};
  EXPECT_EQ(reference_text(row), "reflections, traced");
  row.reference_name = "lists";
  EXPECT_EQ(reference_text(row), "traced, lists");
}

TEST(LedgerReport, is_whole_for_an_empty_ledger) {
  const std::string html = ledger_report(ledger_of({}), {});
  EXPECT_THAT(html, HasSubstr("No measured value gives back time"));
  EXPECT_THAT(html, HasSubstr("There are no pictures"));
  EXPECT_TRUE(html.ends_with("</html>\n"));
}

TEST(LedgerReport, escapes_texts_of_scenes_knobs_and_users) {
  Ledger ledger = ledger_of({value_row("a.<b>", "<script>x</script>", 1.0, 0.01)});
  ledger.header.scene = "<img onerror=\"x\">&'";
  ledger.header.device = "</style>";
  ledger.header.camera = "<i>";
  ledger.rows[0].wrong = "<u>";
  ledger.rows[0].reference_name = "<em>";
  ledger.skipped = {{"<s>", "<b>reason"}};
  const std::string html = ledger_report(ledger, {.command = "<kbd>", .meanings = {{"a.<b>", "<q>"}}});
  for (const char* text :
       {"<img onerror", "<script>x", "</style>,", "<i>", "<u>", "<em>", "<s>", "<b>", "<kbd>", "<q>"})
    EXPECT_THAT(html, Not(HasSubstr(text)));
  EXPECT_EQ(count_of(html, "</style>"), 1u);
}

TEST(LedgerReport, first_screen_has_the_greatest_savings_of_each_bound_once) {
  const Ledger ledger = ledger_of({value_row("a.x", "default", 1.0, 0.001), value_row("a.x", "low", 0.8, 0.005),
                                   value_row("a.x", "lower", 0.7, 0.02), value_row("a.x", "lowest", 0.5, 0.2),
                                   value_row("b.y", "default", 1.0, 0.02), value_row("b.y", "cheap", 0.9, 0.02),
                                   value_row("c.z", "default", 1.0, 0.0), value_row("c.z", "unsure", 0.99, 0.0)});
  const Savings savings = report_data(ledger, {}).savings;
  ASSERT_THAT(savings.no_less_right, SizeIs(1));
  EXPECT_EQ(savings.no_less_right[0].row->value, "cheap");
  ASSERT_THAT(savings.below_001, SizeIs(1));
  EXPECT_EQ(savings.below_001[0].row->value, "low");
  ASSERT_THAT(savings.below_003, SizeIs(1));
  EXPECT_EQ(savings.below_003[0].row->value, "lower");
}

TEST(LedgerReport, offers_no_value_that_chance_made_cheaper) {
  std::vector<LedgerRow> rows = {value_row("a.x", "on", 1.0, 0.0), value_row("a.x", "off", 0.97, 0.0),
                                 value_row("a.x", "far", 0.99, 0.2)};
  rows[1].no_effect = true;  // the pictures are equal, and the 99.8 % intervals overlap
  EXPECT_THAT(report_data(ledger_of(rows), {}).savings.no_less_right, IsEmpty());
}

TEST(LedgerReport, recommends_the_fastest_setting_whose_error_is_not_seen) {
  Ledger ledger = ledger_with_points();
  EXPECT_EQ(report_data(ledger, {}).recommended, nullptr) << "12 ms has an error of 0.05";
  EXPECT_THAT(ledger_report(ledger, {}), HasSubstr("<strong>Nothing.</strong> No measured combination"));
  ledger.rows[0].flip = ErrorPair{0.005, 0.005};
  EXPECT_THAT(ledger_report(ledger, {}), HasSubstr("<strong>Single values only.</strong> No measured combination"));
  ledger.points.insert(ledger.points.begin() + 1, point_at(20.0, 0.02, {{"shadows.filter", "pcf"}}));
  EXPECT_EQ(report_data(ledger, {}).recommended, &ledger.points[1]) << "below 0.03";
  ledger.points.insert(ledger.points.begin() + 2, point_at(30.0, 0.009, {{"shadows.filter", "pcss"}}));
  EXPECT_EQ(report_data(ledger, {}).recommended, &ledger.points[2]) << "below 0.01";
  const std::string html = ledger_report(ledger, {.meanings = {{"shadows.filter", "a sentence", "chs"}}});
  EXPECT_THAT(html, HasSubstr("a frame takes <strong>0.75 (0.73–0.77)</strong> of the time that it takes now, and "
                              "<strong>nobody sees it side by side</strong>"));
  EXPECT_THAT(html,
              HasSubstr("<code>shadows.filter</code> chs → <strong>pcss</strong> <span class=\"meaning\">a sent"));
  EXPECT_LT(html.find("<div class=\"lead\">"), html.find("For a time")) << "the answer comes first";
  EXPECT_THAT(html, HasSubstr("id=\"look\" aria-labelledby=\"look-title\" data-left=\"default\" "
                              "data-right=\"shadows.filter=pcss\""))
      << "and is what the slider shows";
  ledger.points.insert(ledger.points.begin() + 2, point_at(29.9, 0.0095, {{"shadows.near", "off"}}));
  ledger.points[2].measured.on_front = false;
  EXPECT_EQ(report_data(ledger, {}).recommended, &ledger.points[3]) << "as fast, and more right";
  const std::string page = ledger_report(ledger, {});
  const std::size_t below = page.find("<h4>Error below 0.01");
  ASSERT_NE(below, std::string::npos);
  EXPECT_THAT(page.substr(below, page.find("</li>", below) - below), HasSubstr("The settings at the top"));
  ledger.points.erase(ledger.points.begin() + 2);
  ledger.points[2].measured.ratio_high = 1.0;
  EXPECT_EQ(report_data(ledger, {}).recommended, &ledger.points[1]) << "not significantly faster";
  ledger.points[1].measured.flip = ErrorPair{0.9, 0.9};
  ledger.points[3].measured.flip = ErrorPair{0.95, 0.95};
  EXPECT_EQ(report_data(ledger, {}).recommended, &ledger.points[0]) << "no less right than the user's settings";
  EXPECT_THAT(ledger_report(ledger, {}), HasSubstr("<strong>it is no less right than now</strong>"));
}

TEST(LedgerReport, tells_what_antialiasing_does_to_edges) {
  std::vector<LedgerRow> rows = {value_row("lighting.antialiasing", "off", 1.0, 0.0374),
                                 value_row("lighting.antialiasing", "smaa", 1.1, 0.0388)};
  for (LedgerRow& row : rows) row.reference_kind = "accumulated";
  rows[0].edges = EdgeError{{0.2, 0.6}, 20.0, 0.05};
  rows[1].edges = EdgeError{{0.1, 0.3}, 23.5, 0.05};
  std::string html = ledger_report(ledger_of(rows), {});
  EXPECT_THAT(html, HasSubstr("At edges, 5 % of the picture, <code>smaa</code> is nearer to the reference than "
                              "<code>off</code> by 3.5 dB (PSNR); FLIP at edges is 0.100 (p99 0.300) and 0.200 (p99 "
                              "0.600)."));
  EXPECT_THAT(html, HasSubstr("<td class=\"number\">0.0374</td><td class=\"number\">0.0748</td><td "
                              "class=\"number\">0.200</td>"))
      << "mean, 99th percentile, edges";
  rows[1].edges->psnr_db = 20.5;
  EXPECT_THAT(ledger_report(ledger_of(rows), {}), Not(HasSubstr("At edges, 5 %"))) << "less than 1 dB";
  rows[1].edges.reset();
  html = ledger_report(ledger_of(rows), {});
  EXPECT_THAT(html, HasSubstr("<td class=\"number\">–</td>")) << "a ledger of an earlier version";
}

TEST(LedgerReport, answers_what_to_turn_down_for_each_budget) {
  const std::string html = ledger_report(ledger_with_points(), {.meanings = {{"shadows.filter", "width", "chs"}}});
  EXPECT_THAT(html, HasSubstr("No measured setting is as fast as 8 ms: the fastest takes 12.0 ms."));
  EXPECT_THAT(html,
              HasSubstr("<h4>Within 16 ms, 33 ms</h4>\n<p><strong class=\"gain\">0.30 (0.29–0.31)</strong> of your "
                        "time: 12.0 ms (11.8–12.2)"));
  EXPECT_THAT(html, HasSubstr("<h4>Within 50 ms</h4>\n<p><strong class=\"gain\">Your settings</strong>: 40.0 ms."));
  EXPECT_THAT(html, HasSubstr("<h4>Within 100 ms</h4>\n<p><strong class=\"gain\">2.25 ("));
  EXPECT_THAT(html, HasSubstr("Seen when flipping between the pictures (error 0.0500 FLIP, p99 0.0500)."));
  EXPECT_THAT(html, HasSubstr("<code>shadows.filter</code> chs → <strong>hard</strong>")) << "what is turned down";
  EXPECT_THAT(html, HasSubstr("{\n  &quot;shadows.filter&quot;: &quot;hard&quot;\n}"));
  EXPECT_THAT(html,
              HasSubstr("href=\"data:application/json,%7B%0A%20%20%22shadows.filter%22%3A%20%22hard%22%0A%7D%0A\""));
  EXPECT_THAT(html,
              HasSubstr("<h4>Error below 0.01, 0.03</h4>\n<p><strong class=\"gain\">Your settings</strong>: 40.0 ms"));
  EXPECT_THAT(html, HasSubstr("predicted time is 1.25 in the median, 0.500 at worst; for the error it is 0.750"));
  EXPECT_THAT(html, HasSubstr("Error against time of whole settings"));
}

TEST(LedgerReport, without_points_has_no_budgets) {
  Ledger ledger = ledger_with_points();
  ledger.points.clear();
  EXPECT_THAT(ledger_report(ledger, {}), Not(HasSubstr("id=\"budgets\"")));
}

TEST(LedgerReport, offers_the_points_pictures_and_the_whole_frame) {
  ReportRequest request;
  request.picture = [](const std::string& name) { return std::optional("jpeg of " + name); };
  const std::string html = ledger_report(ledger_with_points(), request);
  EXPECT_THAT(html, HasSubstr("<option value=\"shadows.filter=hard\" data-picture=\"shadows.filter=hard\""));
  EXPECT_THAT(html, HasSubstr("<option value=\"reference whole\""));
}

TEST(LedgerReport, escapes_settings_of_points) {
  Ledger ledger = ledger_with_points();
  ledger.points[0] = point_at(12.0, 0.05, {{"<b>", "'<i>\""}});
  const std::string html = ledger_report(ledger, {});
  EXPECT_THAT(html, Not(HasSubstr("<b>")));
  EXPECT_THAT(html, Not(HasSubstr("<i>")));
}

TEST(LedgerReport, offers_no_wrong_value) {
  std::vector<LedgerRow> rows = {value_row("a.x", "default", 1.0, 0.0), value_row("a.x", "fast", 0.3, 0.0)};
  rows[1].wrong = "a light is missing";
  const std::string html = ledger_report(ledger_of(rows), {});
  EXPECT_THAT(html, HasSubstr("No measured value gives back time"));
  EXPECT_THAT(html, HasSubstr("wrong: a light is missing"));
}

TEST(LedgerReport, noise_counts_as_error) {
  std::vector<LedgerRow> rows = {value_row("a.x", "default", 1.0, 0.001), value_row("a.x", "fast", 0.3, 0.002)};
  for (LedgerRow& row : rows) row.reference_noise = 0.04;
  rows[0].reference_noise = 0.0;
  const Savings savings = report_data(ledger_of(rows), {}).savings;
  EXPECT_THAT(savings.below_001, IsEmpty());
  EXPECT_THAT(savings.below_003, IsEmpty());
}

TEST(LedgerReport, knobs_without_reference_have_a_table_and_no_plot) {
  std::vector<LedgerRow> rows = {value_row("a.x", "warm", 1.0, 0.0), value_row("a.x", "cold", 0.5, 0.0)};
  for (LedgerRow& row : rows) {
    row.flip.reset();
    row.reference_kind.clear();
  }
  const std::string html = ledger_report(ledger_of(rows), {});
  EXPECT_THAT(html, HasSubstr("No reference: no value is more right than another."));
  EXPECT_EQ(count_of(html, "<svg"), 0u);
  EXPECT_THAT(html, HasSubstr("0.50 (0.49–0.51)"));
}

TEST(LedgerReport, folds_knobs_without_effect_and_names_skipped_ones) {
  std::vector<LedgerRow> rows = {value_row("a.x", "on", 1.0, 0.0), value_row("a.x", "off", 0.99, 0.0)};
  for (LedgerRow& row : rows) row.no_effect = true;
  Ledger ledger = ledger_of(rows);
  ledger.skipped = {{"grass.lod", "no patch"}, {"fog.radius", "no fog"}, {"grass.cast_distance", "no patch"}};
  const std::string html = ledger_report(ledger, {});
  EXPECT_THAT(html, HasSubstr("Knobs without effect in this scene: 1"));
  EXPECT_THAT(html, HasSubstr("<li>No patch\n<details><summary>Knobs: 2</summary><p><code>grass.lod</code>, "
                              "<code>grass.cast_distance</code></p>"));
  EXPECT_THAT(html, HasSubstr("<li>No fog\n<details><summary>Knobs: 1</summary>"));
  EXPECT_THAT(html, HasSubstr("<a href=\"#called-for\">"));
  EXPECT_EQ(count_of(html, "<svg"), 0u);
}

TEST(LedgerReport, embeds_every_picture_once_and_stays_below_its_size) {
  std::vector<LedgerRow> rows;
  for (int i = 0; i < 40; ++i) rows.push_back(value_row("a.x", std::to_string(i), i == 0 ? 1.0 : 0.9, 0.01));
  rows[1].picture = rows[0].picture;
  const ReportRequest request = {.picture = [](const std::string&) { return "\x89PNG" + std::string(90'000, 'x'); }};
  const Ledger ledger = ledger_of(rows);
  const std::string html = ledger_report(ledger, request);
  EXPECT_LT(html.size(), 3'000'000u);
  EXPECT_EQ(count_of(html, "\n\"a.x0\":\"data:image/png;base64,"), 1u);
  EXPECT_THAT(html, HasSubstr("data-picture=\"a.x39\"")) << "a picture without room is linked";
  EXPECT_THAT(html, Not(HasSubstr("\"a.x39\":")));
  EXPECT_EQ(html, ledger_report(ledger, request));
}

TEST(LedgerReport, shows_no_link_to_an_absent_picture) {
  const Ledger ledger = ledger_of({value_row("a.x", "on", 1.0, 0.01), value_row("a.x", "off", 0.5, 0.01)});
  const std::string html = ledger_report(ledger, {.picture = [](const std::string& name) {
                                           return name == "a.xon" ? std::optional<std::string>("x") : std::nullopt;
                                         }});
  EXPECT_THAT(html, HasSubstr("pictures/a.xon.png"));
  EXPECT_THAT(html, Not(HasSubstr("pictures/a.xoff.png")));
}

TEST(LedgerReport, plots_whatever_a_ledger_holds) {
  const std::string html = ledger_report(test::full_ledger(), {});
  EXPECT_THAT(html, Not(HasSubstr("nan")));
  EXPECT_THAT(html, Not(HasSubstr("=\"inf")));
}

}  // namespace
}  // namespace gloam

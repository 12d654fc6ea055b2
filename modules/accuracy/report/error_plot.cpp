// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "engine/core/text/formatted.h"
#include "modules/accuracy/report/html_text.h"
#include "modules/accuracy/report/sections.h"

namespace gloam {
namespace {

// In units of the SVG.
constexpr double kPlotWidth = 560.0;
constexpr double kPlotHeight = 300.0;
constexpr double kPlotLeft = 78.0;
constexpr double kPlotRight = 548.0;
constexpr double kPlotTop = 14.0;
constexpr double kPlotBottom = 232.0;  // of positive errors
constexpr double kPlotZero = 250.0;    // errors of 0, which have no logarithm

/// A logarithmic axis from `low` at `from` to `high` at `to`.
struct LogAxis {
  double low = 1.0;
  double high = 10.0;
  double from = 0.0;
  double to = 1.0;
  [[nodiscard]] double at(double value) const {
    return from + (to - from) * std::log(value / low) / std::log(high / low);
  }
  /// Round values: 1, 2 and 5 of each decade, fewer over many decades, and equal steps within less than one.
  [[nodiscard]] std::vector<double> ticks() const {
    const bool many = high / low > 1e3;
    std::vector<double> found;
    for (int decade = static_cast<int>(std::floor(std::log10(low))); std::pow(10.0, decade) <= high; ++decade)
      for (const double step : {1.0, 2.0, 5.0})
        if (step == 1.0 || !many) add_tick(step * std::pow(10.0, decade), found);
    if (found.size() >= 3) return found;
    found.clear();
    double step = std::pow(10.0, std::floor(std::log10(high - low)));
    if ((high - low) / step < 4.0) step /= (high - low) / step < 2.0 ? 5.0 : 2.0;
    for (double tick = std::ceil(low / step); tick * step <= high; ++tick) add_tick(tick * step, found);
    return found;
  }

 private:
  void add_tick(double value, std::vector<double>& ticks) const {
    if (value >= low && value <= high) ticks.push_back(value);
  }
};

struct PlotPoint {
  const LedgerRow* row = nullptr;
  double x = 0.0;
  double y = 0.0;
  double low_x = 0.0;  ///< whiskers
  double high_x = 0.0;
};

LogAxis time_axis(const std::vector<const LedgerRow*>& rows, double standard_ms) {
  LogAxis axis = {.low = standard_ms, .high = standard_ms, .from = kPlotLeft, .to = kPlotRight};
  for (const LedgerRow* row : rows) {
    axis.low = std::min(axis.low, standard_ms * row->ratio_low);
    axis.high = std::max(axis.high, standard_ms * row->ratio_high);
  }
  // At least a tenth, so that noise does not look like a difference.
  const double margin = std::max(1.05, std::sqrt(std::max(1.0, 1.1 / (axis.high / axis.low))));
  axis.low /= margin;
  axis.high *= margin;
  return axis;
}

LogAxis error_axis(const std::vector<const LedgerRow*>& rows) {
  LogAxis axis = {.low = 0.0, .high = 0.0, .from = kPlotBottom, .to = kPlotTop};
  for (const LedgerRow* row : rows) {
    const double error = *row->error();
    if (!(error > 0.0)) continue;
    axis.low = axis.low > 0.0 ? std::min(axis.low, error) : error;
    axis.high = std::max(axis.high, error);
  }
  if (!(axis.low > 0.0)) return {.low = 0.01, .high = 0.1, .from = kPlotBottom, .to = kPlotTop};
  axis.low /= 1.8;
  axis.high *= 1.8;
  return axis;
}

std::string plot_line(double x1, double y1, double x2, double y2, std::string_view kind) {
  return formatted("<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" class=\"%s\"/>\n", x1, y1, x2, y2,
                   std::string(kind).c_str());
}

std::string plot_text(double x, double y, std::string_view kind, std::string_view text) {
  return formatted("<text x=\"%.1f\" y=\"%.1f\" class=\"%s\">", x, y, std::string(kind).c_str()) + escaped(text) +
         "</text>\n";
}

std::string plot_frame(const LogAxis& time, const LogAxis& error, bool flip, bool zeros, std::string_view unit) {
  std::string svg;
  for (const double tick : time.ticks()) {
    svg += plot_line(time.at(tick), kPlotTop, time.at(tick), kPlotZero + 8.0, "grid");
    svg += plot_text(time.at(tick), kPlotZero + 24.0, "tick x", formatted("%.3g", tick));
  }
  for (const double tick : error.ticks()) {
    svg += plot_line(kPlotLeft, error.at(tick), kPlotRight, error.at(tick), "grid");
    svg += plot_text(kPlotLeft - 6.0, error.at(tick) + 4.0, "tick y", formatted("%.3g", tick));
  }
  if (zeros) {
    svg += plot_line(kPlotLeft, kPlotZero, kPlotRight, kPlotZero, "grid");
    svg += plot_text(kPlotLeft - 6.0, kPlotZero + 4.0, "tick y", "0");
  }
  for (const double bound : {0.01, 0.03, 0.1}) {
    if (!flip || bound < error.low || bound > error.high) continue;
    svg += plot_line(kPlotLeft, error.at(bound), kPlotRight, error.at(bound), "bound");
    svg += plot_text(kPlotRight, error.at(bound) - 4.0, "bound-text", formatted("%.3g", bound));
  }
  svg += plot_text((kPlotLeft + kPlotRight) / 2.0, kPlotHeight - 6.0, "axis x", "time of a frame, ms");
  return svg +
         formatted("<text transform=\"translate(16 %.1f) rotate(-90)\" class=\"axis x\">",
                   (kPlotTop + kPlotZero) / 2.0) +
         escaped(unit) + "</text>\n";
}

std::string point_mark(const PlotPoint& point) {
  const LedgerRow& row = *point.row;
  if (!row.wrong.empty())
    return formatted("<path class=\"mark wrong\" d=\"M%.1f %.1fl10 10m0 -10l-10 10\"/>", point.x - 5, point.y - 5);
  std::string svg;
  if (row.is_default)
    svg += formatted("<rect class=\"mark default\" x=\"%.1f\" y=\"%.1f\" width=\"18\" height=\"18\"/>", point.x - 9,
                     point.y - 9);
  if (row.error() == 0.0)
    return svg + formatted("<path class=\"mark %s\" d=\"M%.1f %.1fl6 6l-6 6l-6 -6z\"/>",
                           row.on_front ? "front" : "other", point.x, point.y - 6);
  return svg + formatted("<circle class=\"mark %s\" cx=\"%.1f\" cy=\"%.1f\" r=\"5\"/>",
                         row.on_front ? "front" : "other", point.x, point.y);
}

/// Puts names beside their points where they cover no name before them.
class PlotNames {
 public:
  std::string place(const PlotPoint& point, const std::string& name) {
    if (name.empty()) return {};
    const double width = 7.0 * static_cast<double>(name.size());
    constexpr std::array<double, 7> kOffsets = {-12.0, 21.0, -27.0, 36.0, -42.0, 51.0, -57.0};
    const double x =
        std::clamp(point.x, kPlotLeft + width / 2.0, std::max(kPlotLeft + width / 2.0, kPlotRight - width / 2.0));
    for (const double offset : kOffsets) {
      const Box box = {x - width / 2.0, point.y + offset - 11.0, x + width / 2.0, point.y + offset + 3.0};
      const bool inside = box.top >= 0.0 && box.bottom <= kPlotZero + 12.0;
      if (!inside || std::ranges::any_of(placed_, [&](const Box& other) { return box.covers(other); })) continue;
      placed_.push_back(box);
      return plot_text(x, point.y + offset, "name", name);
    }
    return {};  // the table beside the plot has it
  }

  void keep_free(const PlotPoint& point) { placed_.push_back({point.x - 8, point.y - 8, point.x + 8, point.y + 8}); }

 private:
  struct Box {
    double left, top, right, bottom;
    [[nodiscard]] bool covers(const Box& other) const {
      return left < other.right && other.left < right && top < other.bottom && other.top < bottom;
    }
  };
  std::vector<Box> placed_;
};

/// The settings of a combination are too long for a plot.
std::string plot_name(const LedgerRow& row) {
  if (!row.knob.empty()) return row.value;
  return row.is_default ? "default" : row.error() == 0.0 ? "exact" : "";
}

std::string front_line(const std::vector<PlotPoint>& points) {
  std::string path;
  for (const PlotPoint& point : points)
    if (point.row->on_front) path += formatted("%s%.1f %.1f", path.empty() ? "M" : "L", point.x, point.y);
  return path.empty() ? "" : "<path class=\"front-line\" d=\"" + path + "\"/>\n";
}

std::string plot_points(const KnobResults& knob, std::vector<PlotPoint> points) {
  std::ranges::stable_sort(points, {}, &PlotPoint::x);
  PlotNames names;
  std::string svg = front_line(points);
  for (const PlotPoint& point : points) names.keep_free(point);
  for (const PlotPoint& point : points) {
    const LedgerRow& row = *point.row;
    const std::string name = plot_name(row);
    std::string label = row.value + (row.is_default && row.value != "default" ? " (default)" : "");
    if (name != row.value && !name.empty()) label = name + ": " + label;  // begins with the visible text
    label += ": time " + ratio_text(row) + ", error " + error_text_of(row);
    const std::string content = "<title>" + escaped(label) + "</title>" +
                                plot_line(point.low_x, point.y, point.high_x, point.y, "whisker") + point_mark(point) +
                                names.place(point, name);
    svg += look_link(row, knob.standard, content, "aria-label=\"" + escaped(label) + "\"") + "\n";
  }
  return svg;
}

}  // namespace

std::string error_plot(const KnobResults& knob) {
  std::vector<const LedgerRow*> rows;
  for (const LedgerRow* row : knob.rows)
    if (row->error() && row->ratio_low > 0.0 && std::isfinite(*row->error())) rows.push_back(row);
  const double standard_ms = knob.standard != nullptr ? knob.standard->ms.median_ms : 0.0;
  if (rows.empty() || !(standard_ms > 0.0)) return {};
  const LogAxis time = time_axis(rows, standard_ms);
  const LogAxis error = error_axis(rows);
  std::vector<PlotPoint> points;
  for (const LedgerRow* row : rows) {
    const double y = *row->error() > 0.0 ? error.at(*row->error()) : kPlotZero;
    points.push_back({row, time.at(standard_ms * row->ratio), y, time.at(standard_ms * row->ratio_low),
                      time.at(standard_ms * row->ratio_high)});
  }
  const LedgerRow& first = *rows.front();
  const bool flip = !first.counted && first.flip;
  const bool zeros = std::ranges::any_of(rows, [](const LedgerRow* row) { return row->error() == 0.0; });
  const std::string unit = first.counted ? first.counted->unit : flip ? "error, mean FLIP" : "error, RMSE in cd/m²";
  return formatted("<svg class=\"plot\" viewBox=\"0 0 %.0f %.0f\" role=\"group\" aria-label=\"", kPlotWidth,
                   kPlotHeight) +
         "Error against time of " + escaped(knob.name) + ", both axes logarithmic\">\n" +
         plot_frame(time, error, flip, zeros, unit) + plot_points(knob, std::move(points)) + "</svg>\n";
}

}  // namespace gloam

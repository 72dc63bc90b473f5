#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "benchmarks/figures/body_facets.h"
#include "benchmarks/figures/body_picture.h"
#include "benchmarks/figures/gnuplot.h"
#include "core/base/escape.h"

namespace dartboard {
namespace {

using Eigen::Vector2d;

constexpr double line_height = 22;  // [pixels]
constexpr double mark_width = 16, shades_width = 130;

/// "20 mm", "1.5 kPa"
std::string with_prefix(double value, const std::string& unit) {
  constexpr std::array prefixes{"n", "µ", "m", "", "k", "M", "G", "T"};
  const double size = value == 0.0 ? 1.0 : std::abs(value) * (1.0 + 1e-9);
  const double thousands = std::clamp(std::floor(std::log10(size) / 3.0), -3.0, 4.0);
  return fmt::format("{:.3g} {}{}", value / std::pow(1000.0, thousands),
                     prefixes.at(static_cast<std::size_t>(thousands + 3.0)), unit);
}

/// The largest 1, 2 or 5 times a power of ten that is not above x.
double round_below(double x) {
  const double power = std::pow(10.0, std::floor(std::log10(x)));
  return power * (x >= 5.0 * power ? 5.0 : x >= 2.0 * power ? 2.0 : 1.0);
}

/// A part of the footer: its width, and the commands that draw it from a place [pixels].
struct Item {
  double width;
  std::function<std::string(double x, double y)> draw;
};

class Footer {
 public:
  Footer(const Drawing& drawing, const Look& look, const Canvas& canvas) : canvas_(canvas) {
    add_scale(std::min(160.0, 0.5 * drawing.area.size.x() * canvas.pixels) / canvas.pixels);
    if (look.colour == ColourBy::speed || look.colour == ColourBy::stress) add_shades(drawing, look);
    std::set<std::uint32_t> drawn;
    for (const BodyPanel& panel : drawing.panels)
      for (const DrawnFacet& facet : panel.facets) drawn.insert(facet.base);
    for (const auto& [colour, meaning] : legend_of(look))
      if (drawn.contains(colour)) add_mark(colour, meaning);
  }

  double height() const { return line_height * static_cast<double>(rows().size()); }
  std::string commands() {
    std::string text;
    const auto all = rows();
    for (std::size_t row = 0; row < all.size(); ++row) {
      double x = margin;
      for (const Item* item : all[row]) {
        text += item->draw(x, line_height * (static_cast<double>(all.size() - row) - 0.5));
        x += item->width + margin;
      }
    }
    return text;
  }

 private:
  static constexpr double margin = 16;

  std::vector<std::vector<const Item*>> rows() const {
    std::vector<std::vector<const Item*>> all(1);
    double x = margin;
    for (const Item& item : items_) {
      if (!all.back().empty() && x + item.width + margin > canvas_.width) {
        all.emplace_back();
        x = margin;
      }
      all.back().push_back(&item);
      x += item.width + margin;
    }
    return all;
  }
  /// [pixels] Of letters of 11 points of DejaVu Sans.
  static double width_of(const std::string& text) {
    double width = 4.0;
    for (const char c : text) width += c == 'm' || c == 'M' ? 14.0 : c == 'i' || c == 'l' || c == ' ' ? 4.6 : 8.8;
    return width;
  }
  std::string label(const std::string& text, double x, double y, const std::string& colour = "#303030") {
    const Vector2d at = canvas_.at(x, y);
    return fmt::format("set label {} {} at {:.8g},{:.8g} left font \",11\" textcolor rgb \"{}\" noenhanced front\n",
                       ++tag_, gnuplot_string(text), at.x(), at.y(), colour);
  }

  void add_scale(double longest) {
    if (!(longest > 0.0)) return;
    const double length = round_below(longest), wide = length * canvas_.pixels;
    const std::string text = with_prefix(length, "m");
    items_.push_back({wide + 6 + width_of(text), [this, wide, text](double x, double y) {
                        const Vector2d from = canvas_.at(x, y), to = canvas_.at(x + wide, y);
                        const std::string bar = fmt::format(
                            "set arrow {} from {:.8g},{:.8g} to {:.8g},{:.8g} heads size {:.4g},90 front "
                            "linewidth 1.5 linecolor rgb \"#303030\"\n",
                            ++tag_, from.x(), from.y(), to.x(), to.y(), 4.0 / canvas_.pixels);
                        return bar + label(text, x + wide + 6, y);
                      }});
  }
  void add_shades(const Drawing& drawing, const Look& look) {
    std::string unit;
    for (const BodyPanel& panel : drawing.panels) unit = panel.unit;
    const std::string low = look.colour == ColourBy::speed ? "speed 0" : "von Mises stress 0",
                      high = with_prefix(drawing.largest, unit);
    const double before = width_of(low) + 6;
    items_.push_back({before + shades_width + 6 + width_of(high), [this, low, high, before](double x, double y) {
                        std::string text = label(low, x, y);
                        text += label(high, x + before + shades_width + 6, y);
                        constexpr int shades = 16;
                        for (int k = 0; k < shades; ++k) {
                          const double left = x + before + shades_width * k / shades;
                          const Vector2d from = canvas_.at(left, y - 5),
                                         to = canvas_.at(left + shades_width / shades, y + 5);
                          text += fmt::format(
                              "set object {} rectangle from {:.8g},{:.8g} to {:.8g},{:.8g} fillcolor rgb "
                              "\"#{:06x}\" fillstyle solid noborder\n",
                              ++tag_, from.x(), from.y(), to.x(), to.y(), shade_of((k + 0.5) / shades));
                        }
                        return text;
                      }});
  }
  void add_mark(std::uint32_t colour, const std::string& meaning) {
    items_.push_back({mark_width + width_of(meaning), [this, colour, meaning](double x, double y) {
                        const std::string mark = label("■", x, y, fmt::format("#{:06x}", colour));
                        return mark + label(meaning, x + mark_width, y);
                      }});
  }

  const Canvas& canvas_;
  std::vector<Item> items_;
  int tag_ = 1000;  // of the last label, arrow or object
};

}  // namespace

std::string Sheet::time_of(const BodyPanel& panel, int tag, double middle) const {
  return fmt::format(
      "set label {} {} at {:.6g},{:.6g} center font \",{:g}\"\n", tag,
      gnuplot_string(fmt::format("t = {:.3g} s{}", panel.time, panel.is_empty() ? ", nothing left" : "")), middle,
      canvas.low.y() + up_to_times / canvas.pixels, font - 3);
}

Sheet sheet_of(const Drawing& drawing, const Look& look, const std::string& title, double pixels, int width,
               double middle, double font) {
  Sheet sheet{.canvas = {.pixels = pixels, .width = width}, .font = font};
  Canvas& canvas = sheet.canvas;
  Footer footer(drawing, look, canvas);
  const double below = Sheet::times + footer.height(), high = drawing.area.size.y();
  sheet.up_to_times = footer.height() + 0.5 * Sheet::times;
  canvas.height = static_cast<int>(std::lround(pixels * high + Sheet::head + below));
  canvas.low = Vector2d(middle - width / (2 * pixels), -high / 2 - below / pixels);
  const Vector2d top = canvas.at(width, canvas.height), head = canvas.at(width / 2.0, canvas.height - 20);
  sheet.commands =
      fmt::format(
          "set encoding utf8\nunset key\nunset border\nunset tics\nset margins 0,0,0,0\nset size ratio -1\n"
          "set label 1000 {} at {:.8g},{:.8g} center font \",{:g}\" noenhanced\n"
          "set xrange [{:.8g}:{:.8g}]\nset yrange [{:.8g}:{:.8g}]\nset style fill solid 1.0 noborder\n",
          quoted_title(title, width, font, 1), head.x(), head.y(), font, canvas.low.x(), top.x(), canvas.low.y(),
          top.y()) +
      footer.commands();
  return sheet;
}

}  // namespace dartboard

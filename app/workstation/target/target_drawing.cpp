#include "app/workstation/target/target_drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

namespace dottrack::workstation {
namespace {

// Millimetres.
constexpr double kMargin = 12.0;  // around the panel: crop marks
constexpr double kCropLength = 8.0;
constexpr double kCropGap = 3.0;
constexpr double kBarHeight = 2.0;
constexpr double kSmallestLetter = 3.5;
constexpr double kLargestLetter = 10.0;
constexpr double kThin = 0.2;

struct Colours {
  std::string_view panel;
  std::string_view dot;
  std::string_view mark;  // too faint to be taken for a dot or a part of one
};

Colours colours_of(core::Polarity polarity) {
  return polarity == core::Polarity::dark ? Colours{"#ffffff", "#000000", "#d8d8d8"}
                                          : Colours{"#000000", "#ffffff", "#303030"};
}

// The largest of 1, 2 and 5 times a power of ten that is at most a quarter of the panel.
double bar_length(double panel) {
  double length = std::pow(10.0, std::floor(std::log10(0.25 * panel)));
  for (const double factor : {5.0, 2.0}) {
    if (factor * length <= 0.25 * panel) return factor * length;
  }
  return length;
}

struct Page {
  double width = 0.0;   // of the panel
  double height = 0.0;  // of the panel
  double letter = 0.0;  // in the caption below the panel

  double all_width() const { return width + 2.0 * kMargin; }
  double all_height() const { return height + 2.0 * kMargin + kBarHeight + 3.0 * letter; }
};

Page page_of(const Panel& panel) {
  const double width = panel.length_m * 1e3;
  return {width, panel.width_m * 1e3, std::clamp(0.01 * width, kSmallestLetter, kLargestLetter)};
}

class Drawing {
 public:
  Drawing(const core::Target& target, const Panel& panel, core::Polarity polarity)
      : target_(target),
        page_(page_of(panel)),
        width_(page_.width),
        height_(page_.height),
        colours_(colours_of(polarity)) {}

  std::string text() {
    add(R"(<svg xmlns="http://www.w3.org/2000/svg" width="{0:g}mm" height="{1:g}mm" )"
        R"(viewBox="{2:g} {2:g} {0:g} {1:g}" font-family="sans-serif">)",
        page_.all_width(), page_.all_height(), -kMargin);
    add("<title>target of {} dots, {:g} x {:g} mm</title>", target_.dots.size(), width_, height_);
    add(R"(<rect x="{0:g}" y="{0:g}" width="{1:g}" height="{2:g}" fill="#ffffff"/>)", -kMargin,
        page_.all_width(), page_.all_height());
    draw_panel();
    draw_axes();
    for (std::size_t i = 0; i < target_.dots.size(); ++i) draw_dot(i);
    draw_bar();
    return text_ + "</svg>\n";
  }

 private:
  template <class... Parts>
  void add(fmt::format_string<Parts...> line, Parts&&... parts) {
    text_ += fmt::format(line, std::forward<Parts>(parts)...) + "\n";
  }

  void line(double x1, double y1, double x2, double y2, std::string_view colour, double width) {
    add(R"(<line x1="{:g}" y1="{:g}" x2="{:g}" y2="{:g}" stroke="{}" stroke-width="{:g}"/>)", x1,
        y1, x2, y2, colour, width);
  }

  void write(double x, double y, double size, std::string_view colour, std::string_view anchor,
             std::string_view words) {
    add(R"(<text x="{:g}" y="{:g}" font-size="{:g}" fill="{}" text-anchor="{}">{}</text>)", x, y,
        size, colour, anchor, words);
  }

  void draw_panel() {
    add(R"(<rect x="0" y="0" width="{:g}" height="{:g}" fill="{}" stroke="#000000" )"
        R"(stroke-width="{:g}"/>)",
        width_, height_, colours_.panel, kThin);
    for (const double x : {0.0, width_}) {
      const double out = x > 0.0 ? 1.0 : -1.0;
      for (const double y : {0.0, height_}) {
        const double down = y > 0.0 ? 1.0 : -1.0;
        line(x + out * kCropGap, y, x + out * (kCropGap + kCropLength), y, "#000000", kThin);
        line(x, y + down * kCropGap, x, y + down * (kCropGap + kCropLength), "#000000", kThin);
      }
    }
  }

  // From the origin, the panel's middle; a tenth of the panel long.
  void draw_axes() {
    const double length = 0.1 * std::min(width_, height_);
    const double x = 0.5 * width_;
    const double y = 0.5 * height_;
    const double stroke = 0.02 * length;
    const double head = 0.15 * length;
    const double letter = 0.25 * length;
    line(x - 0.3 * length, y, x + length, y, colours_.mark, stroke);
    line(x, y + 0.3 * length, x, y - length, colours_.mark, stroke);
    add(R"(<path d="M {0:g} {1:g} l {2:g} {3:g} v {4:g} z M {5:g} {6:g} l {3:g} {7:g} h {4:g} z" )"
        R"(fill="{8}"/>)",
        x + length + head, y, -head, -0.4 * head, 0.8 * head, x, y - length - head, head,
        colours_.mark);
    write(x + length + 1.4 * head, y + 0.35 * letter, letter, colours_.mark, "start", "x");
    write(x, y - length - 1.4 * head, letter, colours_.mark, "middle", "y");
  }

  void draw_dot(std::size_t i) {
    const core::TargetDot& dot = target_.dots[i];
    const double diameter = dot.diameter_m * 1e3;
    const double x = 0.5 * width_ + dot.position_m.x() * 1e3;
    const double y = 0.5 * height_ - dot.position_m.y() * 1e3;
    add(R"(<circle cx="{:.10g}" cy="{:.10g}" r="{:g}" fill="{}"/>)", x, y, 0.5 * diameter,
        colours_.dot);
    write(x + 0.7 * diameter, y + 0.1 * diameter, 0.28 * diameter, colours_.mark, "start",
          fmt::format("{}", i));
  }

  void draw_bar() {
    const double length = bar_length(width_);
    const double y = height_ + kMargin;
    for (int i = 0; i < 10; ++i) {
      add(R"(<rect x="{:g}" y="{:g}" width="{:g}" height="{:g}" fill="{}" stroke="#000000" )"
          R"(stroke-width="{:g}"/>)",
          0.1 * length * i, y, 0.1 * length, kBarHeight, i % 2 == 0 ? "#000000" : "#ffffff", kThin);
    }
    const double letter = page_.letter;
    write(0.0, y + kBarHeight + 1.3 * letter, letter, "#000000", "start",
          fmt::format("{:g} mm", length));
    write(0.0, y + kBarHeight + 2.7 * letter, letter, "#000000", "start",
          fmt::format("panel {:g} x {:g} mm, dots {:g} mm", width_, height_,
                      target_.dots[0].diameter_m * 1e3));
  }

  const core::Target& target_;
  Page page_;
  double width_;
  double height_;
  Colours colours_;
  std::string text_;
};

struct Paper {
  std::string_view name;
  double long_side = 0.0;
  double short_side = 0.0;
};

constexpr std::array<Paper, 4> kPapers{
    {{"A4", 297.0, 210.0}, {"A3", 420.0, 297.0}, {"A2", 594.0, 420.0}, {"A1", 841.0, 594.0}}};

}  // namespace

std::string target_svg(const core::Target& target, const Panel& panel, core::Polarity polarity) {
  return Drawing(target, panel, polarity).text();
}

std::string target_csv(const core::Target& target) {
  std::string text = "dot,x_m,y_m,z_m,diameter_m,nx,ny,nz\n";
  for (std::size_t i = 0; i < target.dots.size(); ++i) {
    const core::TargetDot& dot = target.dots[i];
    text += fmt::format("{},{:.4f},{:.4f},{:.4f},{:g},0,0,1\n", i, dot.position_m.x(),
                        dot.position_m.y(), dot.position_m.z(), dot.diameter_m);
  }
  return text;
}

std::string how_to_print(const Panel& panel) {
  const Page page = page_of(panel);
  const double width = page.all_width();
  const double height = page.all_height();
  const double bar = bar_length(panel.length_m * 1e3);
  const std::string check = fmt::format("; the bar below the panel is then {:g} mm long", bar);
  for (const Paper& paper : kPapers) {
    if (std::max(width, height) > paper.long_side || std::min(width, height) > paper.short_side) {
      continue;
    }
    return fmt::format("print on {} at 100 %, not fitted to the page", paper.name) + check;
  }
  return fmt::format(
             "print at 100 % on a roll or plate of {:.0f} x {:.0f} mm, or as a poster on several "
             "sheets of paper",
             width, height) +
         check;
}

}  // namespace dottrack::workstation

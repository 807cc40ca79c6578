#include "report/plot.h"

#include <array>
#include <cmath>
#include <sstream>
#include <utility>
#include <vector>

#include "pipeline/files/pending_file.h"
#include "pipeline/files/read_file.h"
#include "pipeline/frame/error.h"
#include "report/axis_scale.h"
#include "report/child.h"
#include "report/label_places.h"
#include "report/pareto.h"

namespace rinkaku::report {
namespace {

constexpr double kWidth_px = 760, kHeight_px = 470, kLeft_px = 76, kRight_px = 22, kTop_px = 14, kBottom_px = 60;
constexpr int kFont_px = 13, kLabel_px = 12;
constexpr std::size_t kLargestPlot_bytes = 16 << 20;
// What is black on white and white on black; gnuplot knows no CSS.
constexpr const char* kInk = "#010203";
// Of one strength before white as before black.
constexpr std::array kColours{"#3b7dd8", "#d9730d", "#2a9d5c", "#c44e9a", "#7a6ff0", "#d1495b",
                              "#1f9e9e", "#a07a1c", "#8d6e63", "#6b7f8f", "#5b8c2a", "#b05ad6"};

struct Sheet {
  AxisScale x, y;
  glm::dvec2 pixel(double px, double py) const {
    return {kLeft_px + x.part(px) * (kWidth_px - kLeft_px - kRight_px),
            kHeight_px - kBottom_px - y.part(py) * (kHeight_px - kTop_px - kBottom_px)};
  }
};

bool has_spread(const Point& p) { return p.x_high > p.x_low && p.x_low > 0; }

Sheet sheet_of(const Plot& plot) {
  std::vector<double> xs, ys;
  for (const Series& series : plot.series) {
    for (const Point& p : series.points) {
      xs.push_back(p.x), ys.push_back(p.y);
      if (has_spread(p)) xs.push_back(p.x_low), xs.push_back(p.x_high);
    }
  }
  return {axis_scale(plot.x, xs), axis_scale(plot.y, ys)};
}

// For gnuplot's double quotes, without its markup.
std::string plain(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '"' || c == '\\' || c == '\n' || c == '`' || c == '$') continue;
    if (c == '_' || c == '^' || c == '@' || c == '&' || c == '{' || c == '}' || c == '~') out += "\\\\";
    out += c;
  }
  return out;
}

void write_axis(std::ostream& out, const char* name, const AxisScale& scale, const Axis& axis) {
  if (scale.log) out << "set logscale " << name << "\n";
  out << "set " << name << "range [" << scale.least << ':' << scale.most << "]\n";
  out << "set " << name << "tics nomirror out scale 0.7,0.4 (";
  for (std::size_t i = 0; i < scale.marks.size(); ++i) {
    const AxisScale::Mark& mark = scale.marks[i];
    out << (i > 0 ? ", " : "") << '"' << mark.text << "\" " << mark.at << (mark.text.empty() ? " 1" : "");
  }
  out << ") textcolor rgb \"" << kInk << "\"\n";
  out << "set " << name << "label \"" << plain(axis.title) << "\" textcolor rgb \"" << kInk << "\""
      << (*name == 'x' ? " offset 0,0.4" : "") << "\n";
}

// The front as a line of steps: what lies above and to the right of it is beaten.
std::vector<glm::dvec2> front_of(const Plot& plot, const Sheet& sheet) {
  std::vector<glm::dvec2> points, front;
  for (const Series& series : plot.series) {
    for (const Point& p : series.points) points.emplace_back(p.x, p.y);
  }
  for (const std::size_t i : pareto_front(points)) {
    front.emplace_back(sheet.x.shown(points[i].x), sheet.y.shown(points[i].y));
  }
  return front;
}

void write_labels(std::ostream& out, const Plot& plot, const Sheet& sheet) {
  LabelField field;
  field.least = {kLeft_px + 2, kTop_px}, field.most = {kWidth_px - 4, kHeight_px - kBottom_px - 2};
  field.font_px = kLabel_px;
  std::vector<LabelWish> wishes;
  std::vector<std::size_t> colours;
  for (std::size_t s = 0; s < plot.series.size(); ++s) {
    const Series& series = plot.series[s];
    std::vector<glm::dvec2> line;
    for (const Point& p : series.points) {
      const glm::dvec2 at = sheet.pixel(p.x, p.y);
      field.marks.push_back(at);
      line.push_back(at);
      if (has_spread(p)) field.lines.push_back({sheet.pixel(p.x_low, p.y), sheet.pixel(p.x_high, p.y)});
      if (!p.label.empty()) wishes.push_back({at, p.label}), colours.push_back(s);
    }
    if (series.joined) {
      if (!line.empty()) wishes.push_back({line.back(), series.name}), colours.push_back(s);
      field.lines.push_back(std::move(line));
    }
  }
  if (plot.front) {
    std::vector<glm::dvec2> steps;
    for (const glm::dvec2& p : front_of(plot, sheet)) {
      const glm::dvec2 at = sheet.pixel(p.x, p.y);
      if (!steps.empty()) steps.emplace_back(at.x, steps.back().y);
      steps.push_back(at);
    }
    field.lines.push_back(std::move(steps));
  }
  const std::vector<LabelPlace> places = place_labels(wishes, field);
  const auto screen = [](const glm::dvec2& p) {
    return std::to_string(p.x / kWidth_px) + "," + std::to_string(1 - p.y / kHeight_px);
  };
  for (std::size_t i = 0; i < places.size(); ++i) {
    const LabelPlace& place = places[i];
    const char* colour = kColours[colours[i] % kColours.size()];
    // Text stands on the side of its box that faces the point, so that a wrong guess of its width leaves no hole.
    const double off = place.middle.x - wishes[i].at.x;
    const int side = off > place.half_size.x ? 1 : off < -place.half_size.x ? -1 : 0;
    const glm::dvec2 anchor(place.middle.x - side * place.half_size.x, place.middle.y);
    if (place.far) {
      const glm::dvec2 end(anchor.x, anchor.y + (side != 0 ? 0 : anchor.y < wishes[i].at.y ? 7 : -7));
      out << "set arrow from screen " << screen(wishes[i].at) << " to screen " << screen(end)
          << " nohead lw 0.7 lc rgb \"" << colour << "\" back\n";
    }
    out << "set label \"" << plain(wishes[i].text) << "\" at screen " << screen(anchor)
        << (side > 0   ? " left"
            : side < 0 ? " right"
                       : " center")
        << " textcolor rgb \"" << colour << "\" font \"," << kLabel_px << "\" front\n";
  }
}

std::string script(const Plot& plot, const Sheet& sheet, const std::string& output) {
  std::ostringstream out;
  out.precision(9);
  out << "set encoding utf8\nset terminal svg size " << kWidth_px << ',' << kHeight_px << " dynamic enhanced name \""
      << "plot\" font \"system-ui,Helvetica,Arial,sans-serif," << kFont_px << "\"\nset output \"" << output
      << "\"\nunset key\nset border 3 lc rgb \"#8a9099\"\nset grid xtics ytics lt 1 lw 0.4 lc rgb \"#8a9099\"\n"
      << "set lmargin at screen " << kLeft_px / kWidth_px << "\nset rmargin at screen " << 1 - kRight_px / kWidth_px
      << "\nset tmargin at screen " << 1 - kTop_px / kHeight_px << "\nset bmargin at screen " << kBottom_px / kHeight_px
      << "\n";
  write_axis(out, "x", sheet.x, plot.x);
  write_axis(out, "y", sheet.y, plot.y);
  write_labels(out, plot, sheet);
  std::string draws;
  const auto draw = [&draws](const std::string& what) { draws += (draws.empty() ? "plot " : ", ") + what; };
  if (plot.front) {
    const std::vector<glm::dvec2> front = front_of(plot, sheet);
    out << "$front << EOD\n";
    for (const glm::dvec2& p : front) out << p.x << ' ' << p.y << "\n";
    out << "EOD\n";
    if (front.size() > 1) draw("$front using 1:2 with steps lw 3.5 lc rgb \"#e3b341\" dt 1");
    draw("$front using 1:2 with points pt 6 ps 1.7 lw 2 lc rgb \"#e3b341\"");
  }
  for (std::size_t s = 0; s < plot.series.size(); ++s) {
    const Series& series = plot.series[s];
    const std::string data = "$s" + std::to_string(s),
                      colour = std::string(" lc rgb \"") + kColours[s % kColours.size()] + "\"";
    bool bars = false;
    out << data << " << EOD\n";
    for (const Point& p : series.points) {
      const bool spread = has_spread(p);
      bars |= spread;
      out << sheet.x.shown(p.x) << ' ' << sheet.y.shown(p.y) << ' ' << (spread ? p.x_low : sheet.x.shown(p.x)) << ' '
          << (spread ? p.x_high : sheet.x.shown(p.x)) << "\n";
    }
    out << "EOD\n";
    if (series.points.empty()) continue;
    if (bars) draw(data + " using 1:2:3:4 with xerrorbars pt 0 ps 0 lw 1" + colour);
    if (series.joined) draw(data + " using 1:2 with lines lw 1.4" + colour);
    draw(data + " using 1:2 with points pt 7 ps 0.75" + colour);
  }
  out << draws << "\n";
  return out.str();
}

void replace_all(std::string& text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size()) {
    text.replace(at, from.size(), to);
  }
}

// What gnuplot wrote, as it may stand in a page beside others of its kind.
std::string for_a_page(std::string svg, const std::string& id) {
  svg.erase(0, svg.find("<svg"));
  if (const std::size_t desc = svg.find("<title>"), end = svg.find("</desc>"); end != std::string::npos) {
    svg.erase(desc, end + 7 - desc);
  }
  for (const char* name : {"gpPt", "gpDot", "textbox", "greybox", "gnuplot_canvas", "gnuplot_plot_"}) {
    replace_all(svg, std::string("'#") + name, "'#" + id + "-" + name);
    replace_all(svg, std::string("id='") + name, "id='" + id + "-" + name);
    replace_all(svg, std::string("id=\"") + name, "id=\"" + id + "-" + name);
  }
  replace_all(svg, "rgb(  1,   2,   3)", "var(--ink)");
  replace_all(svg, "rgb(1,2,3)", "var(--ink)");
  return svg;
}

}  // namespace

std::string svg_plot(const Plot& plot, const std::string& id, const std::filesystem::path& scratch) {
  const Sheet sheet = sheet_of(plot);
  const std::string base = (scratch / id).string();
  files::write_file(base + ".gp", script(plot, sheet, base + ".svg"));
  const ChildRun run = run_child({kPlotter, base + ".gp"}, base + ".log");
  if (run.status != 0) {
    throw runtime_failure(kPlotter,
                          "failed with status " + std::to_string(run.status) + " at the plot '" + plot.title + "'",
                          "see whether gnuplot --version works");
  }
  return for_a_page(files::read_file(base + ".svg", kLargestPlot_bytes), id);
}

}  // namespace rinkaku::report

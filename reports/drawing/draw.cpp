#include <fmt/format.h>
#include <gnuplot-iostream.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <sstream>
#include <system_error>

#include "reports/drawing/figure.h"
#include "reports/drawing/palette.h"
#include "reports/drawing/plot_script.h"
#include "reports/text/files.h"
#include "reports/text/number.h"

namespace trammel::reports {

namespace {

namespace fs = std::filesystem;

/// Returns the gnuplot settings that all figures share. Gnuplot prints texts without interpreting
/// markup (noenhanced).
std::string plot_header(const Figure& figure, const fs::path& svg) {
  std::ostringstream out;
  out << "reset session\n"
      << "set encoding utf8\nset minussign\n"
      << "set terminal svg size " << figure.width << ',' << figure.height
      << " dynamic noenhanced font 'Helvetica,15' linewidth 1 rounded background '"
      << palette::kPaper << "'\n"
      << "set output " << gnuplot_path(svg) << '\n'
      << "set border 3" << lc(palette::kStructure) << '\n'
      << "set tics nomirror out scale 0.5 textcolor rgb '" << palette::kMuted << "'\n"
      << "set grid" << lc(palette::kGrid) << " lw 1 lt 1," << lc(palette::kGrid) << " lw 1 lt 1\n"
      << "set xtics offset 0,0.35\nset ytics offset 0.3,0\n"
      << "set xlabel offset 0,0.8 textcolor rgb '" << palette::kInk << "'\n"
      << "set ylabel offset 0.6,0 textcolor rgb '" << palette::kInk << "'\n"
      << "set key outside below center horizontal Left reverse samplen 1.6 spacing 1.15 height 0.5 "
         "textcolor rgb '"
      << palette::kInk << "'\n"
      << "set style fill solid 1 noborder\n";
  return out.str();
}

/// Returns SVG attributes with the ranges, pixel positions and labels of both axes. The script
/// page.js uses them to show the values of a curve at the mouse pointer. The returned text is empty
/// if an axis has no label. It is also empty if both axes have the same scale, because such
/// drawings show a mechanism, not curves.
/// @param extent  file that gnuplot wrote, with the ranges of x and y, and their pixel positions (y
/// upwards)
std::string axes_of(const Figure& figure, const fs::path& extent) {
  const auto label = [&](const std::string& start) {
    const std::size_t at = figure.commands.find(start), from = at + start.size();
    return at == std::string::npos
               ? std::string()
               : figure.commands.substr(from, figure.commands.find('\'', from) - from);
  };
  const std::string x = label("set xlabel '"), y = label("set ylabel '");
  const bool place = figure.commands.find("set size ratio") != std::string::npos;
  if (x.empty() || y.empty() || place || !fs::exists(extent)) return "";
  std::istringstream in(read_file(extent));
  std::array<double, 8> ends{};
  for (double& end : ends)
    if (!(in >> end)) return "";
  std::string numbers;
  for (std::size_t i = 0; i < ends.size(); ++i)
    numbers += shortest_decimal(i < 6 ? ends[i] : figure.height - ends[i]) + " ";
  const auto is_log = [&](const char* axis) {
    return figure.commands.find(std::string("set logscale ") + axis) != std::string::npos;
  };
  return " data-axes=\"" + numbers + (is_log("x") ? "1 " : "0 ") + (is_log("y") ? "1" : "0") +
         "\" data-x=\"" + xml_escaped(x) + "\" data-y=\"" + xml_escaped(y) + "\"";
}

fs::path svg_path(const fs::path& folder, const Figure& figure) {
  return folder / (figure.id + ".svg");
}

/// Returns the first lines of an SVG file, with a hash of the drawing, its gnuplot commands and its
/// texts.
std::string head_of(const Figure& figure, const std::string& program, const std::string& svg) {
  const std::string all =
      program + plot_header(figure, "/") + figure.commands + figure.title + figure.alt + svg;
  return "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<?xml-stylesheet "
         "href=\"figure.css\"?>\n<!-- " +
         std::to_string(std::hash<std::string>{}(all)) + " -->\n";
}

/// Reads an earlier drawing of the figure.
/// @returns true if the drawing exists, is complete, and has the same gnuplot commands and texts.
/// It must also be from the same version of this program.
bool reuse_drawing(const fs::path& former, const std::string& program, Figure& figure) {
  const fs::path path = svg_path(former, figure);
  if (!fs::is_regular_file(path)) return false;
  const std::string drawn = read_file(path);
  const std::size_t start = drawn.find("<svg");
  if (start == std::string::npos) return false;
  figure.svg = drawn.substr(start);
  return drawn.compare(0, start, head_of(figure, program, figure.svg)) == 0;
}

void draw_by_gnuplot(const std::vector<Figure*>& figures, const fs::path& folder) {
  if (figures.empty()) return;
  const auto extent_path = [&](const Figure& figure) { return folder / (figure.id + ".extent"); };
  for (const Figure* figure : figures) fs::remove(svg_path(folder, *figure));
  // Ignores SIGPIPE. If gnuplot closes its pipe, writing to the pipe then fails instead of ending
  // this program.
  const auto previous = std::signal(SIGPIPE, SIG_IGN);
  {
    // With -d, gnuplot ignores the settings of the user. The command `timeout` ends gnuplot if it
    // hangs.
    const std::string command =
        "LC_ALL=C.UTF-8 timeout -k 5 " + std::to_string(120 + figures.size()) + " gnuplot -d";
    std::array<Gnuplot, 2> both{{Gnuplot(command), Gnuplot(command)}};  // two concurrent processes
    std::size_t number = 0;
    for (const Figure* figure : figures)
      both[number++ % 2]
          << plot_header(*figure, svg_path(folder, *figure)) << figure->commands << "unset output\n"
          << "set print " << gnuplot_path(extent_path(*figure)) << '\n'
          << "print GPVAL_X_MIN, GPVAL_X_MAX, GPVAL_Y_MIN, GPVAL_Y_MAX, GPVAL_TERM_XMIN, "
             "GPVAL_TERM_XMAX, GPVAL_TERM_YMIN, GPVAL_TERM_YMAX\nunset print\n";
  }
  std::signal(SIGPIPE, previous);
  for (Figure* figure : figures) {
    const fs::path path = svg_path(folder, *figure);
    const std::string drawn = fs::exists(path) ? read_file(path) : "";
    if (drawn.find("</svg>") == std::string::npos)  // gnuplot does not report write errors
      throw std::system_error(EIO, std::generic_category(),
                              path.string() + ": gnuplot wrote an incomplete drawing");
    figure->svg = tidy_svg(drawn, figure->id, figure->title, figure->alt);
    figure->svg.insert(figure->svg.find(" role="), axes_of(*figure, extent_path(*figure)));
    fs::remove(extent_path(*figure));
  }
}

}  // namespace

std::string slug(const std::string& text) {
  constexpr std::size_t kMaxLength = 100, kHashLength = 9;
  std::string out;
  std::uint32_t hash = 2166136261U;  // FNV-1a hash
  for (const char c : text) {
    hash = (hash ^ static_cast<unsigned char>(c)) * 16777619U;
    if ((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9')) {
      out += c;
    } else if (c >= 'A' && c <= 'Z') {
      out += static_cast<char>(c - 'A' + 'a');
    } else if (!out.empty() && out.back() != '-') {
      out += '-';
    }
  }
  while (!out.empty() && out.back() == '-') out.pop_back();
  if (out == text && text.size() <= kMaxLength && !text.empty()) return out;
  out.resize(std::min(out.size(), kMaxLength - kHashLength));
  return (out.empty() ? "x" : out) + fmt::format("-{:08x}", hash);
}

bool has_gnuplot() {
  return std::system("command -v gnuplot >/dev/null 2>&1") == 0;
}

void draw(const std::vector<Figure*>& figures, const fs::path& folder, const fs::path& cache,
          const std::string& program) {
  fs::create_directories(folder);
  std::vector<Figure*> missing;
  for (Figure* figure : figures)
    if (figure->svg.empty() && (cache.empty() || !reuse_drawing(cache, program, *figure)))
      missing.push_back(figure);
  draw_by_gnuplot(missing, folder);
  for (Figure* figure : figures) {
    write_file(svg_path(folder, *figure), head_of(*figure, program, figure->svg) + figure->svg);
    write_file(folder / (figure->id + ".csv"), to_csv(figure->data));
    if (!figure->moving.empty() && !figure->is_linked)  // page.js animates only inlined SVG
      figure->svg.insert(figure->svg.rfind("</svg>"),
                         "<metadata>" + xml_escaped(figure->moving) + "</metadata>\n");
  }
}

}  // namespace trammel::reports

#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace trammel::reports {

/// Returns a text in single quotes, in which gnuplot does not expand anything. Apostrophes become
/// typographic, because gnuplot misreads a doubled apostrophe at the start of a string.
[[nodiscard]] std::string gnuplot_string(const std::string& text);

/// Returns a path in double quotes. All characters except letters, digits and "/.-" are octal
/// escapes, so that a path cannot end the string, be expanded or contain a command.
[[nodiscard]] std::string gnuplot_path(const std::filesystem::path& path);

/// Returns a tick mark with its text and position, for the gnuplot command `set xtics (...)`.
[[nodiscard]] std::string tic(const std::string& text, double at);

/// Returns a text without its characters beyond `max_characters`. A shortened text ends with an
/// ellipsis.
[[nodiscard]] std::string shortened(const std::string& text, std::size_t max_characters);
[[nodiscard]] std::size_t character_count(const std::string& utf8);

/// Returns the line color as an option of gnuplot: " lc rgb '#1f5fa8'".
[[nodiscard]] std::string lc(const std::string& color);

/// Collects the data and commands of one figure. All texts from results pass through
/// `gnuplot_string`, so that a text cannot become a gnuplot command.
class PlotScript {
 public:
  /// Rows of data points. An empty row interrupts a curve.
  using Rows = std::vector<std::vector<double>>;

  void command(const std::string& line);

  /// Adds a curve to the current plot unless `rows` is empty. A curve without a title has no entry
  /// in the legend.
  /// @param style  gnuplot options of the curve: "using 1:2 with lines lw 2"
  void curve(const Rows& rows, const std::string& style, const std::string& title = "");

  /// Adds an entry to the key (legend) without a curve.
  void key_entry(const std::string& style, const std::string& title);

  /// Adds a text to the plot.
  /// @param place  position and options of the text in gnuplot's syntax: "graph 0.1,0.2 left"
  void label(const std::string& text, const std::string& place);

  /// Plots all curves that were added since the last call. At least one curve is required.
  void plot();

  /// Places the key (legend) below the plot, in as many columns as the titles permit.
  /// @returns the height of the key [px].
  int place_key_below(const std::vector<std::string>& titles, std::size_t max_columns = 4);

  void range(const std::string& axis, double low, double high);
  void axis_label(const std::string& axis, const std::string& text);

  /// Sets a logarithmic axis over complete decades, with labels 10⁻⁶ 10⁻⁴ ...
  void log_axis(const std::string& axis, double low, double high);

  [[nodiscard]] const std::string& commands() const { return commands_; }

 private:
  std::string commands_;
  std::vector<std::string> curves_;
  int blocks_ = 0;
};

}  // namespace trammel::reports

#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace trammel::reports {

/// Text for gnuplot in single quotes, where nothing is expanded or marked up. Its own apostrophes
/// become typographic ones: gnuplot misreads a doubled one at the start of a string.
[[nodiscard]] std::string gnuplot_string(const std::string& text);

/// A file for gnuplot: all but letters, digits and "/.-" as octal escapes in double quotes, so that
/// nothing of it can end the string, be expanded or be a command.
[[nodiscard]] std::string gnuplot_path(const std::filesystem::path& path);

/// A label of an axis with its place, for `set xtics (...)`.
[[nodiscard]] std::string tic(const std::string& text, double at);

/// At most `max_characters` characters, with an ellipsis where cut.
[[nodiscard]] std::string shortened(const std::string& text, std::size_t max_characters);
[[nodiscard]] std::size_t characters(const std::string& utf8);

/// " lc rgb '#1f5fa8'".
[[nodiscard]] std::string lc(const std::string& color);

/// Collects the data and commands of one figure. All text passes through `gnuplot_string`, all
/// numbers are written by us, so no result can turn into a command.
class PlotScript {
 public:
  /// One row a point; an empty row breaks a line.
  using Rows = std::vector<std::vector<double>>;

  void command(const std::string& line);

  /// Adds a curve to the plot under way; nothing where there are no rows. `style` follows the data
  /// source ("using 1:2 with lines lw 2"); without a title it stays out of the key.
  void curve(const Rows& rows, const std::string& style, const std::string& title = "");

  /// An entry of the key alone.
  void key_entry(const std::string& style, const std::string& title);

  /// A text at a point: `place` is gnuplot's coordinates and options ("graph 0.1,0.2 left").
  void label(const std::string& text, const std::string& place);

  /// Draws the curves collected since the last call. At least one curve is needed.
  void plot();

  /// Lays the key below the plot in as many columns as its texts allow.
  /// @returns the height that it takes [px].
  int key_below(const std::vector<std::string>& titles);

  void range(const std::string& axis, double low, double high);
  void axis_label(const std::string& axis, const std::string& text);

  /// A logarithmic axis over whole decades, labelled 10⁻⁶ 10⁻⁴ ...
  void log_axis(const std::string& axis, double low, double high);

  [[nodiscard]] const std::string& commands() const { return commands_; }

 private:
  std::string commands_;
  std::vector<std::string> curves_;
  int blocks_ = 0;
};

}  // namespace trammel::reports

#pragma once

#include <array>
#include <string>

namespace trammel::reports::palette {

/// Colors of all figures. They are distinguishable with the common types of color blindness and in
/// gray print (after Okabe and Ito, darkened for thin lines on white). The file figure.css maps
/// each color to a color for dark pages. A color that is added to palette.h also needs a line in
/// figure.css.
inline constexpr const char* kPaper = "#ffffff";
inline constexpr const char* kInk = "#1d232b";
inline constexpr const char* kMuted = "#5b6470";
inline constexpr const char* kStructure = "#a6aeb8";
inline constexpr const char* kGrid = "#e4e7eb";
inline constexpr const char* kShade = "#eef0f3";
inline constexpr const char* kAmber = "#f3e3bd";
inline constexpr const char* kBlush = "#f9e1dc";
inline constexpr const char* kPlate = "#dde6f0";

inline constexpr std::array<const char*, 7> kSeries = {"#1f5fa8", "#c8500a", "#16806a", "#a3478f",
                                                       "#4a9fd4", "#b0830a", "#5b6470"};
/// Colors of a map of a quantity, one for each range of values: light blue for low values to dark
/// blue for high values.
inline constexpr std::array<const char*, 7> kSequence = {"#e3edf7", "#c3d9ee", "#98bfe1", "#6a9fd0",
                                                         "#437eb8", "#265c96", "#123b6b"};
/// Point types of gnuplot for the curves of a figure: disc, square, triangle, diamond, ...
inline constexpr std::array<int, 7> kFilledPoint = {7, 5, 9, 13, 11, 15, 7};
inline constexpr std::array<int, 7> kOpenPoint = {6, 4, 8, 12, 10, 14, 6};

[[nodiscard]] inline std::string filled_marker(std::size_t i) {
  return std::to_string(kFilledPoint[i % kFilledPoint.size()]);
}
[[nodiscard]] inline std::string open_marker(std::size_t i) {
  return std::to_string(kOpenPoint[i % kOpenPoint.size()]);
}
[[nodiscard]] inline const char* color(std::size_t i) {
  return kSeries[i % kSeries.size()];
}

}  // namespace trammel::reports::palette

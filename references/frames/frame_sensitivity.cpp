#include <sstream>

#include "references/frames/programs.h"
#include "references/frames/wittrick_williams.h"
#include "references/numerics/real.h"

/// Derivatives of the exact natural frequencies of a frame with respect to its numbers.
namespace trammel::references {

namespace {

/// A decimal of twelve digits, so that what is read back is what was meant.
Json decimal(double value) {
  std::ostringstream text;
  text.precision(12);
  text << value;
  return Json::parse(text.str());
}

class Differences {
 public:
  explicit Differences(const Arguments& arguments)
      : arguments_(arguments), count_(arguments.count("count")) {
    const Json& json = arguments.json();
    for (const std::string& text : arguments.texts("pointers")) {
      const Json::json_pointer pointer(text);
      if (!json.contains(pointer) || !json[pointer].is_number()) {
        arguments.fail("pointers", "expected pointers to numbers (got " + text + ")");
      }
      if (!pointers_.empty() && json[pointer] != json[pointers_.front()]) {
        arguments.fail("pointers", "expected pointers to equal numbers");
      }
      pointers_.push_back(pointer);
    }
    if (pointers_.empty()) arguments.fail("pointers", "expected at least one pointer");
  }

  [[nodiscard]] std::vector<Real> central(double step) const {
    const std::vector<Real> above = frequencies(step);
    const std::vector<Real> below = frequencies(-step);
    std::vector<Real> rate;
    for (std::size_t i = 0; i < above.size(); ++i) {
      rate.push_back((above[i] - below[i]) / (2 * Real(decimal(step).dump())));
    }
    return rate;
  }

 private:
  [[nodiscard]] std::vector<Real> frequencies(double change) const {
    Json json = arguments_.json();
    for (const auto& pointer : pointers_)
      json[pointer] = decimal(json[pointer].get<double>() + change);
    return frame_frequencies(frame_from_arguments(Arguments(json, "")), count_).frequencies;
  }

  const Arguments& arguments_;
  int count_;
  std::vector<Json::json_pointer> pointers_;
};

}  // namespace

std::vector<Real> frame_sensitivity_program(const Arguments& arguments) {
  const auto step = static_cast<double>(arguments.positive("step"));
  const Differences differences(arguments);
  const std::vector<Real> a = differences.central(step);
  const std::vector<Real> b = differences.central(step / 2);
  const std::vector<Real> c = differences.central(step / 4);
  std::vector<Real> rate;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Real ab = (4 * b[i] - a[i]) / 3;
    const Real bc = (4 * c[i] - b[i]) / 3;
    rate.push_back((16 * bc - ab) / 15);
  }
  return rate;
}

}  // namespace trammel::references

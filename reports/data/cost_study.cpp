#include "reports/data/cost_study.h"

#include <algorithm>
#include <limits>

#include "reports/text/number.h"

namespace trammel::reports {

namespace {

constexpr int kAnyNumber = std::numeric_limits<int>::max();

CostSetting read_setting(const JsonView& view, const std::string& norm) {
  CostSetting setting;
  setting.curve = view.at("curve").text();
  setting.curve_title = view.at("curve_title").text();
  setting.title = view.at("title").text();
  setting.status = view.at("standing").text();
  setting.reason = view.find("reason").text_or("");
  setting.value = view.find("value").optional_number();
  if (const JsonView error = view.find("error"); !error.null()) {
    setting.max = error.at("max").optional_number();
    setting.rms = error.at("rms").optional_number();
    setting.mean = error.at("mean").optional_number();
    setting.error = error.at(norm).optional_number();
  }
  setting.cpu_s = view.at("cpu_s").number();
  setting.relative = view.at("relative_time").optional_number();
  if (const JsonView time = view.find("time"); !time.null()) {
    setting.spread = time.at("spread").number();
    const double unit = setting.relative.value_or(0) / setting.cpu_s;
    setting.lower = unit * time.at("lower_quartile_s").number();
    setting.upper = unit * time.at("upper_quartile_s").number();
  }
  for (const auto& [name, n] : view.find("counters").members())
    setting.counters.emplace_back(name, n.number());
  setting.pareto_optimal = view.at("on_front").boolean();
  return setting;
}

CostStudy read_study(const JsonView& view) {
  CostStudy study;
  study.id = view.at("id").text();
  study.family = view.at("family").text();
  study.title = view.at("title").text();
  study.description = view.find("description").text_or("");
  study.reference_solution = view.at("truth").text();
  study.scale = view.at("scale").text();
  study.norm = view.at("norm").text();
  study.conclusion = view.at("words").text();
  study.wall_s = view.at("wall_s").number();
  for (const JsonView& entry : view.at("settings").entries())
    study.settings.push_back(read_setting(entry, study.norm));
  const int count = static_cast<int>(study.settings.size());
  study.baseline = static_cast<std::size_t>(view.at("baseline").integer(count));
  for (const JsonView& entry : view.at("cheapest").entries()) {
    std::optional<std::size_t> setting;
    if (!entry.at("setting").null())
      setting = static_cast<std::size_t>(entry.at("setting").integer(count));
    study.cheapest.emplace_back(entry.at("error").number(), setting);
  }
  const JsonView both = view.at("repeatability");
  study.on_both_fronts = static_cast<std::size_t>(both.at("shared").integer(kAnyNumber));
  study.on_either_front = static_cast<std::size_t>(both.at("either").integer(kAnyNumber));
  study.largest_difference = both.at("largest_difference").optional_number().value_or(0);
  return study;
}

/// 1 240 000 with thin spaces.
std::string grouped(double n) {
  std::string digits = shortest(n);
  if (digits.find_first_not_of("0123456789") != std::string::npos) return trimmed(n, 4);
  std::string out;
  for (std::size_t i = 0; i < digits.size(); ++i) {
    if (i > 0 && (digits.size() - i) % 3 == 0) out += "\u202f";
    out += digits[i];
  }
  return out;
}

}  // namespace

CostStudies read_cost_studies(const JsonView& view) {
  CostStudies all;
  all.quick = view.at("sweep").text() == "quick";
  all.repeats = view.at("repeats").integer(kAnyNumber);
  all.kMaxSpread = view.at("widest_spread").number();
  for (const JsonView& entry : view.at("studies").entries())
    all.studies.push_back(read_study(entry));
  return all;
}

std::string counters_text(const std::vector<std::pair<std::string, double>>& counters) {
  std::string text;
  for (const auto& [name, n] : counters) {
    if (n == 0 && name == "steps") continue;  // most computations have none
    std::string words = name;
    std::replace(words.begin(), words.end(), '_', ' ');
    text += (text.empty() ? "" : ", ") + grouped(n) + " " + words;
  }
  return text;
}

}  // namespace trammel::reports

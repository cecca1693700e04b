#include "reports/page/render.h"
#include "reports/sections/sections.h"
#include "reports/text/number.h"

namespace trammel::reports {

Data history_section(const Results& results, const std::optional<Figure>& figure) {
  if (!results.history || results.history->calls.empty()) return object({{"has_rows", false}});
  const History& history = *results.history;
  const std::size_t changes = history.changes.size() + history.work.size();
  std::string words = count(history.calls.size(), "call") + "; ";
  if (history.since == 0) {
    words += "no call without failures comes before the newest one.";
  } else {
    words += changes == 0 ? "nothing" : count(changes, "value");
    words +=
        " changed since call " + std::to_string(history.since) + ", the last one without failures.";
  }
  return object({{"has_rows", true},
                 {"words", words},
                 {"figure", figure ? figure_data(*figure) : Data(false)}});
}

}  // namespace trammel::reports

#include <algorithm>

#include "reports/drawing/palette.h"
#include "reports/drawing/plot_script.h"
#include "reports/figures/figures.h"
#include "reports/text/number.h"

namespace trammel::reports {

namespace {

/// @param work, time  rows of (call, value relative to the first call)
std::string caption_of(const PlotScript::Rows& work, const PlotScript::Rows& time) {
  const auto last = [](const PlotScript::Rows& rows) { return trimmed(rows.back()[1], 3); };
  std::string text =
      "Counted work and processor time of all runs of a call, relative to the first call. Times "
      "are those of complete calls on the newest call's machine.";
  if (!work.empty()) text += " The newest call has " + last(work) + " times the work";
  if (time.size() > 1)
    text += (work.empty() ? " The newest call has " : " and ") + last(time) + " times the time";
  return text + (work.empty() && time.size() < 2 ? "" : ".");
}

}  // namespace

Figure history_figure(const History& history) {
  const std::string machine = history.calls.back().machine;
  PlotScript::Rows time, work, failing;
  double first_time = 0, first_work = 0;
  Table table;
  table.heads = words_in("call date commit runs checks failures cpu_s work");
  for (const HistoryCall& call : history.calls) {
    const auto number = static_cast<double>(call.id);
    const auto counted = static_cast<double>(call.work);
    const bool is_timed = call.cpu_s > 0 && call.machine == machine;
    if (is_timed && first_time == 0) first_time = call.cpu_s;
    if (first_work == 0) first_work = counted;
    if (is_timed) time.push_back({number, call.cpu_s / first_time});
    if (first_work > 0) work.push_back({number, counted / first_work});
    if (!call.green()) failing.push_back({number, first_work > 0 ? counted / first_work : 1});
    table.rows.push_back({number, call.date, call.commit, static_cast<double>(call.runs),
                          static_cast<double>(call.checks), static_cast<double>(call.failures),
                          call.cpu_s, counted});
  }
  PlotScript script;
  script.axis_label("x", "call");
  script.axis_label("y", "relative to the first");
  const std::size_t step = std::max<std::size_t>(history.calls.size() / 8, 1);  // integer tics
  script.command("set yrange [0:*]; set xtics " + std::to_string(history.calls.front().id) + "," +
                 std::to_string(step));
  script.range("x", static_cast<double>(history.calls.front().id) - 0.5,
               static_cast<double>(history.calls.back().id) + 0.5);
  const int key = script.key_below({"counted work", "processor time", "with failures"});
  const std::string line = "with linespoints lw 1.6 ps 0.8 pt ";
  script.curve(work, line + "7" + lc(palette::color(0)), "counted work");
  script.curve(time, line + "5" + lc(palette::color(1)), "processor time");
  script.curve(failing, "with points lw 2 ps 1.6 pt 2" + lc(palette::kInk), "with failures");
  script.plot();
  return {.id = "history",
          .title = "Work and time of the calls",
          .caption = caption_of(work, time),
          .alt = "Curves of counted work and processor time over the calls.",
          .height = 260 + key,
          .commands = script.commands(),
          .data = std::move(table)};
}

}  // namespace trammel::reports

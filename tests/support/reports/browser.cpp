#include "tests/support/reports/browser.h"

#include <cstdlib>
#include <fstream>
#include <stdexcept>

#include "tests/support/reports/workspace.h"

namespace trammel::testing {

namespace {

namespace fs = std::filesystem;

std::string browser() {
  for (const char* name : {"chromium", "chromium-browser", "google-chrome"})
    if (std::system(("command -v " + std::string(name) + " >/dev/null 2>&1").c_str()) == 0)
      return name;
  throw std::runtime_error("no Chromium on this machine: install the Debian package chromium");
}

constexpr const char* kProbeScript = R"(<script>
addEventListener("load", () => {
  document.querySelectorAll("details").forEach(d => d.open = true);
  const root = document.documentElement;
  const drawings = [...document.querySelectorAll('figure svg:not(.moving):not(.reading svg)')];
  const shownAs = s => s.matches(".still") ? s.parentElement.querySelector(".moving") : s;
  const sized = drawings.filter(s => shownAs(s).getBoundingClientRect().height > 20 && s.querySelector("path, text"));
  const scrolls = e => e.closest(".scroll") && !e.matches(".scroll");
  const wide = [...document.querySelectorAll("main *, header *, nav *, footer *")].filter(e =>
    !e.closest("svg") && !scrolls(e) && !e.matches(".visually-hidden") &&
    e.getBoundingClientRect().right > innerWidth + 1);
  const shown = e => e && getComputedStyle(e).display !== "none" && e.getBoundingClientRect().width > 0;
  const misplaced = [...document.querySelectorAll("table.checks tr.values td:nth-child(2) ")].filter(e => {
    const head = [...e.closest("table").querySelectorAll("thead th")].find(h => h.textContent === "Target");
    return shown(head) && Math.abs(head.getBoundingClientRect().right - e.getBoundingClientRect().right) > 1;
  });
  parent.postMessage({width: innerWidth, misplaced: misplaced.length, scrollWidth: root.scrollWidth,
    figures: sized.length, empty: drawings.length - sized.length, wide: wide.length,
    wideNames: wide.slice(0, 5).map(e => e.tagName + "." + e.className).join(" ")}, "*");
});
</script></body>)";

constexpr const char* frame = R"(<!DOCTYPE html><html><body><script>
addEventListener("message", e => Object.assign(document.documentElement.dataset, e.data));
</script><iframe src="inside.html" scrolling="no" style="border: 0; height: 2000px; width: )";

}  // namespace

Visit visit_in_frame(const fs::path& page, int width) {
  const Workspace workspace;
  std::string text = read_text_file(page);
  text.replace(text.rfind("</body>"), 7, kProbeScript);
  if (const std::size_t head = text.find("<head>"); head != std::string::npos)
    text.insert(head + 6, "<base href=\"file://" + page.parent_path().string() + "/\">");
  std::ofstream(workspace.path() / "inside.html") << text;
  const fs::path outside = workspace.path() / "outside.html";
  std::ofstream(outside) << frame << width << "px\"></iframe></body></html>";
  return visit(outside);
}

Visit visit(const fs::path& page) {
  const Workspace workspace;
  const fs::path document = workspace.path() / "document.html";
  const fs::path console = workspace.path() / "console.txt";
  const std::string command =
      "HOME='" + workspace.path().string() + "' timeout 90 " + browser() +
      " --headless --no-sandbox --disable-gpu --disable-quic --no-first-run"
      " --disable-background-networking --disable-component-update --disable-sync"
      " --enable-logging=stderr --dump-dom --virtual-time-budget=2000 --user-data-dir='" +
      (workspace.path() / "profile").string() + "' --window-size=1400,2000 'file://" +
      page.string() + "' >'" + document.string() + "' 2>'" + console.string() + "'";
  if (std::system(command.c_str()) != 0)
    throw std::runtime_error("Chromium failed: " + read_text_file(console));
  return {read_text_file(document), read_text_file(console)};
}

int measured_number(const Visit& visit, const std::string& name) {
  const std::string start = "data-" + name + "=\"";
  const std::size_t at = visit.document.find(start);
  return at == std::string::npos ? -1 : std::atoi(visit.document.c_str() + at + start.size());
}

}  // namespace trammel::testing

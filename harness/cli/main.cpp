#include <fcntl.h>
#include <malloc.h>
#include <unistd.h>

#include "harness/base/processes.h"
#include "harness/cli/command_line.h"
#include "reports/drawing/figure.h"
#include "reports/page/report.h"

int main(int argc, char** argv) {
  // Opens closed standard streams, so that files opened later do not replace them.
  int null = 0;
  while (null >= 0 && null <= STDERR_FILENO) null = open("/dev/null", O_RDONLY);
  close(null);
  // Memory of large matrices is kept for reuse instead of being returned to the system.
  for (const int threshold : {M_MMAP_THRESHOLD, M_TRIM_THRESHOLD}) mallopt(threshold, 1 << 30);
  trammel::harness::set_exit_on_out_of_memory(2, "trammel: expected a machine with more memory\n");
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  return trammel::harness::run_command_line(
      arguments,
      {trammel::reports::write_report, trammel::reports::write_junit, trammel::reports::has_gnuplot,
       trammel::reports::write_code_comparison, trammel::reports::write_comparison});
}

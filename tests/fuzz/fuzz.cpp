#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <unistd.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <array>
#include <cstring>
#include <fstream>
#include <iostream>
#include <new>
#include <thread>

#include "harness/base/json_file.h"
#include "harness/base/processes.h"
#include "harness/base/rows.h"
#include "harness/base/stopwatch.h"
#include "tests/fuzz/target.h"

// Runs the program's readers and analysis code on invalid or unusual inputs, in a few forked
// processes with many inputs each. The inputs in the folder tests/fuzz/corpus, which once caused
// errors, run first.

namespace trammel::fuzz {
namespace {

namespace fs = std::filesystem;
using harness::ProcessOutcome;

struct Options {
  std::uint32_t inputs = 2000, seed = 1;
  int only = -1;
  std::string kind;
  fs::path findings = "fuzz-findings", corpus = TRAMMEL_SOURCE_DIR "/tests/fuzz/corpus";
  double limit_s = 0.25;
  unsigned jobs = std::max(1U, std::thread::hardware_concurrency());
  std::vector<fs::path> files;
};

/// Progress and outcome of the test of one input, in shared memory that outlives the test process.
struct Slot {
  enum class Stage { open, reading, computing, done } stage;
  Outcome outcome;
  std::array<char, 400> message;

  void close(Outcome how, const std::string& text) {
    stage = Stage::done;
    outcome = how;
    std::strncpy(message.data(), text.c_str(), message.size() - 1);
  }
};

/// Slots, one for each input, in memory that forked processes share until the program ends.
struct Board {
  explicit Board(std::size_t count)
      : size(count),
        slots(static_cast<Slot*>(mmap(nullptr, (count + 1) * sizeof(Slot), PROT_READ | PROT_WRITE,
                                      MAP_SHARED | MAP_ANONYMOUS, -1, 0))) {
    if (slots == MAP_FAILED) throw std::bad_alloc();
  }
  Slot& operator[](std::size_t i) { return slots[i]; }
  std::size_t size;
  Slot* slots;
};

using Maker = std::function<Input(std::size_t)>;

/// Limits the remaining processor time of this process [s]. Also sets a limit of wall time, which
/// is much larger.
void limit_processor_time(double seconds) {
  const auto whole = static_cast<time_t>(seconds);
  const itimerval timer{{0, 0}, {whole, static_cast<suseconds_t>(1e6 * (seconds - double(whole)))}};
  setitimer(ITIMER_PROF, &timer, nullptr);
  alarm(60 + 20 * static_cast<unsigned>(seconds));
}

void test_batch(Board& board, const Maker& make, std::size_t first, std::size_t last,
                double limit_s) {
  const fs::path folder = fs::temp_directory_path() / ("trammel-fuzz-" + std::to_string(getpid()));
  fs::create_directories(folder);
  std::cout.setstate(std::ios::badbit);  // discards the output of commands
  constexpr double kReading_s = 5;       // limit for reading an input
  for (std::size_t i = first; i < last; ++i) {
    Slot& slot = board[i];
    const Input input = make(i);
    slot.stage = Slot::Stage::reading;
    limit_processor_time(kReading_s);
    const Verdict verdict = test_input(input, folder, [&] {
      slot.stage = Slot::Stage::computing;
      limit_processor_time(limit_s);
    });
    limit_processor_time(kReading_s);
    slot.close(verdict.outcome, verdict.message);
  }
  fs::remove_all(folder);
}

/// Processes all inputs in forked processes, and stores their outcomes in the slots. If a process
/// dies, another process continues with the next input.
void test_all(Board& board, const Maker& make, const Options& options) {
  constexpr std::size_t kBatch = 50;
  std::vector<std::pair<std::size_t, std::size_t>> batches;
  for (std::size_t i = 0; i < board.size; i += kBatch)
    batches.emplace_back(i, std::min(board.size, i + kBatch));
  constexpr std::size_t kMemory = std::size_t{1} << 30;
  while (!batches.empty()) {
    std::vector<harness::ProcessTask> tasks;
    for (const auto& [first, last] : batches)
      tasks.push_back({[&, first = first, last = last] {
                         test_batch(board, make, first, last, options.limit_s);
                         return std::string();
                       },
                       100000});
    std::vector<std::pair<std::size_t, std::size_t>> left;
    const auto ended = [&](std::size_t task, const ProcessOutcome& outcome) {
      auto [i, last] = batches[task];
      while (i < last && board[i].stage == Slot::Stage::done) ++i;
      if (i == last) return;
      const bool timed_out = outcome.termination == ProcessOutcome::Termination::timed_out ||
                             outcome.text.find("signal 27,") != std::string::npos;  // timer
      const bool computing = board[i].stage == Slot::Stage::computing;
      const bool no_memory = outcome.termination == ProcessOutcome::Termination::out_of_memory;
      board[i].close(no_memory    ? Outcome::no_memory
                     : !timed_out ? Outcome::crash
                     : computing  ? Outcome::stopped
                                  : Outcome::hang,
                     outcome.text);
      if (i + 1 < last) left.emplace_back(i + 1, last);
    };
    if (harness::run_in_worker_processes(tasks, {options.jobs, kMemory}, ended) != 0) return;
    batches = std::move(left);
  }
}

/// Prints a table of outcomes by type of input, and a line for each finding, that is, each input
/// that revealed a fault of the program. Saves these inputs.
/// @returns the number of findings
std::size_t print_findings(Board& board, const Maker& make, const std::string& what,
                           const Options& options) {
  std::map<std::string, std::array<std::size_t, kOutcomes>> counts;
  std::size_t findings = 0;
  for (std::size_t i = 0; i < board.size; ++i) {
    const Input input = make(i);
    const Outcome outcome = board[i].outcome;
    for (const std::string& row : {input.kind, std::string("total")})
      ++counts[row][static_cast<std::size_t>(outcome)];
    if (options.only >= 0 || !options.files.empty())
      std::cout << input.how << '\n'
                << to_string(outcome) << ": " << board[i].message.data() << '\n';
    if (!is_finding(outcome)) continue;
    ++findings;
    const fs::path file =
        options.findings / input.kind / std::to_string(i) / (input.name + ".json");
    if (options.files.empty()) {
      fs::create_directories(file.parent_path());
      std::ofstream(file, std::ios::binary) << input.text;
    }
    std::cout << what << ' ' << i << " (" << input.kind << ' ' << input.name
              << "): " << to_string(outcome) << ": " << board[i].message.data() << "\n  "
              << input.how << '\n';
  }
  std::vector<harness::Column> columns = {"kind", "inputs"};
  for (std::size_t i = 1; i < kOutcomes; ++i) columns.emplace_back(to_string(Outcome(i)));
  harness::Rows table(columns);
  for (const auto& [kind, count] : counts) {
    std::size_t inputs = 0;
    for (const std::size_t n : count) inputs += n;
    std::vector<harness::Json> row = {kind, inputs};
    for (std::size_t i = 1; i < kOutcomes; ++i) row.emplace_back(count[i]);
    table.add(row);
  }
  table.print(std::cout);
  return findings;
}

/// Tests the inputs in files with names KIND/NAME.json, as in tests/fuzz/corpus.
std::size_t run_files(const std::vector<fs::path>& files, Options options) {
  const Maker make = [&](std::size_t i) {
    return Input{files[i].parent_path().filename(),
                 files[i].stem(),
                 harness::read_text(files[i]),
                 "",
                 false,
                 0};
  };
  options.limit_s = 5;
  Board board(files.size());
  test_all(board, make, options);
  return print_findings(board, make, "file", options);
}

std::size_t run_generated_inputs(const Options& options) {
  const Mutator mutator(std::vector<Json>{sample_results()});
  const bool one = options.only >= 0;
  const Maker make = [&](std::size_t i) {
    const auto number = static_cast<std::uint32_t>(one ? options.only : static_cast<int>(i));
    return mutator.make(options.seed, number, options.kind);
  };
  Board board(one ? 1 : options.inputs);
  const harness::Stopwatch watch;
  test_all(board, make, options);
  const std::size_t findings = print_findings(board, make, "input", options);
  rusage used{};
  getrusage(RUSAGE_CHILDREN, &used);
  std::cout << "seed " << options.seed << ", " << watch.wall_s() << " s, largest memory "
            << used.ru_maxrss / 1024 << " MB\n";
  return findings;
}

int run(int argc, char** argv) {
  Options options;
  CLI::App app("Runs the program on invalid and unusual inputs");
  app.add_option("--inputs", options.inputs, "Number of inputs")->capture_default_str();
  app.add_option("--seed", options.seed, "Seed of the inputs")->capture_default_str();
  app.add_option("--only", options.only, "Only the input of this number, with a full description");
  app.add_option("--kind", options.kind, "Only inputs of this kind")
      ->check(CLI::IsMember(Mutator::kinds()));
  app.add_option("--limit", options.limit_s, "Processor time of each computation [s]")
      ->check(CLI::Range(0.01, 1000.0))
      ->capture_default_str();
  app.add_option("-j,--jobs", options.jobs, "Simultaneous processes")->capture_default_str();
  app.add_option("--findings", options.findings, "Folder for inputs with findings")
      ->capture_default_str();
  app.add_option("files", options.files,
                 "Files of the form KIND/NAME.json instead of the corpus and new inputs");
  CLI11_PARSE(app, argc, argv);
  if (!options.files.empty()) return run_files(options.files, options) == 0 ? 0 : 1;
  std::vector<fs::path> known;
  for (const auto& entry : fs::recursive_directory_iterator(options.corpus))
    if (entry.path().extension() == ".json") known.push_back(entry.path());
  std::cout << "corpus\n";
  const std::size_t again = run_files(known, options);
  std::cout << "new\n";
  return again + run_generated_inputs(options) == 0 ? 0 : 1;
}

}  // namespace
}  // namespace trammel::fuzz

int main(int argc, char** argv) {
  return trammel::fuzz::run(argc, argv);
}

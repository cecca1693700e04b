#include <cmath>
#include <cstdio>
#include <exception>
#include <iostream>
#include <string>
#include <vector>

#include "references/derivations/program.h"
#include "references/derivations/stored.h"

/// trammel_derive: stored references against what their derivations give today.
namespace {

using namespace trammel::derive;

const char* const usage =
    "Usage: trammel_derive REFERENCE-FILE...\n"
    "       trammel_derive --program NAME [--arguments JSON]\n"
    "       trammel_derive --list\n"
    "\n"
    "With reference files: prints every stored value, the derived one and their difference, each\n"
    "against the stated uncertainty. With --program: prints the derived values alone.\n"
    "Exit status: 0 everything holds, 1 a stored value is not what comes out, 2 bad usage or "
    "input.\n";

int list_programs() {
  for (const auto& [name, program] : programs()) {
    std::cout << name << "\n    " << program.summary << "\n    arguments: " << program.arguments
              << "\n";
  }
  return 0;
}

int run_program(const std::string& name, const std::string& text) {
  const Json arguments = Json::parse(text, nullptr, false);
  if (arguments.is_discarded()) throw DerivationError("--arguments: not JSON");
  for (const double value : derive(name, arguments)) std::printf("%.17g\n", value);
  return 0;
}

bool print_comparison(const std::string& file) {
  Comparison comparison;
  try {
    comparison = compare_with_derivation(read_json(file));
  } catch (const DerivationError& error) {
    const std::string message = error.what();
    throw DerivationError(message.rfind(file, 0) == 0 ? message : file + ": " + message);
  }
  if (comparison.program.empty()) {
    std::printf("%s: no derivation\n", comparison.id.c_str());
    return true;
  }
  std::printf("%s [%s] by %s\n  %24s %24s %10s %12s\n", comparison.id.c_str(),
              comparison.unit.c_str(), comparison.program.c_str(), "stored", "derived",
              "difference", "uncertainty");
  for (std::size_t i = 0; i < comparison.stored.size(); ++i) {
    const double derived = i < comparison.derived.size() ? comparison.derived[i] : NAN;
    std::printf("  %24.17g %24.17g %10.2e %12.2e\n", comparison.stored[i], derived,
                derived - comparison.stored[i], comparison.uncertainty[i]);
  }
  if (comparison.derived.size() > comparison.stored.size()) {
    std::printf("  %zu more derived than stored\n",
                comparison.derived.size() - comparison.stored.size());
  }
  std::printf("  %s\n", comparison.holds() ? "holds" : "DOES NOT HOLD");
  return comparison.holds();
}

int run(const std::vector<std::string>& words) {
  if (words.empty()) {
    std::cerr << usage;
    return 2;
  }
  if (words[0] == "--help" || words[0] == "-h") {
    std::cout << usage;
    return 0;
  }
  if (words[0] == "--list" && words.size() == 1) return list_programs();
  if (words[0] == "--program" && words.size() == 2) return run_program(words[1], "{}");
  if (words[0] == "--program" && words.size() == 4 && words[2] == "--arguments") {
    return run_program(words[1], words[3]);
  }
  bool holds = true;
  for (const std::string& word : words) {
    if (word.rfind("--", 0) == 0) {
      std::cerr << "trammel_derive: cannot use '" << word << "' here\n" << usage;
      return 2;
    }
    holds = print_comparison(word) && holds;
  }
  return holds ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(std::vector<std::string>(argv + 1, argv + argc));
  } catch (const DerivationError& error) {
    std::cerr << "trammel_derive: " << error.what() << "\n";
    return 2;
  } catch (const std::exception& error) {
    std::cerr << "trammel_derive: our own fault: " << error.what() << "\n";
    return 3;
  }
}

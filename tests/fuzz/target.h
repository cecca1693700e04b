#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "tests/fuzz/mutator.h"

/// Code under test, which runs in the process of the fuzz test. It reads an input file, computes
/// the case in the file and judges the results, as the program does.
namespace trammel::fuzz {

enum class Outcome { unfinished, valid, refused, no_memory, crash, hang, stopped, internal, wrong };
inline constexpr std::size_t kOutcomes = 9;
/// Returns the name of an outcome. hang: time limit exceeded while reading. stopped: time limit
/// exceeded while computing, which is permitted. internal: an exception that no input may cause.
/// wrong: invalid input was accepted, or refused without a position in the file.
[[nodiscard]] const char* to_string(Outcome outcome);
[[nodiscard]] bool is_finding(Outcome outcome);

struct Verdict {
  Outcome outcome = Outcome::unfinished;
  std::string message;
};

/// Returns results of a few small cases. The mutator changes them to produce results files.
[[nodiscard]] harness::Json sample_results();

/// Reads an input. If it is a case, computes it and judges the results.
/// @param folder     folder for the input file
/// @param computing  called after reading, before the computation
[[nodiscard]] Verdict test_input(const Input& input, const std::filesystem::path& folder,
                                 const std::function<void()>& computing);

}  // namespace trammel::fuzz

#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "tests/fuzz/mutator.h"

/// What is done with an input: all that the program does with such a file, in this process.
namespace trammel::fuzz {

enum class Outcome { unfinished, valid, refused, no_memory, crash, hang, stopped, internal, wrong };
inline constexpr std::size_t kOutcomes = 9;
/// hang: while it was read; stopped: while it was computed, which a case may ask for; internal: an
/// exception that no input may cause; wrong: what is invalid was accepted, or refused without a
/// line that says where.
[[nodiscard]] const char* to_string(Outcome outcome);
[[nodiscard]] bool is_finding(Outcome outcome);

struct Verdict {
  Outcome outcome = Outcome::unfinished;
  std::string message;
};

/// Results of a few small cases, to start from.
[[nodiscard]] harness::Json sample_results();

/// @param folder     where its file is written
/// @param computing  called when all is read
[[nodiscard]] Verdict take(const Input& input, const std::filesystem::path& folder,
                           const std::function<void()>& computing);

}  // namespace trammel::fuzz

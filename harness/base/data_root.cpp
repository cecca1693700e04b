#include <cstdlib>
#include <vector>

#include "harness/base/environment.h"
#include "harness/base/errors.h"

namespace trammel::harness {
namespace {

namespace fs = std::filesystem;

bool has_case_schema(const fs::path& folder) {
  std::error_code error;
  return fs::exists(folder / "cases" / "schema" / "case.schema.json", error);
}

fs::path find_data_root() {
  if (const char* set = std::getenv("TRAMMEL_HOME"); set != nullptr && *set != '\0') {
    if (has_case_schema(set)) return fs::absolute(set);
    throw InputError("TRAMMEL_HOME: expected a folder that contains cases/schema (got '" +
                     std::string(set) + "')");
  }
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  const std::vector<fs::path> places = {TRAMMEL_SOURCE_DIR,
                                        program.parent_path().parent_path() / "share" / "trammel"};
  for (const fs::path& place : places)
    if (has_case_schema(place)) return place;
  throw InputError("TRAMMEL_HOME: not set; expected the folder of cases/ and references/ (" +
                   places.front().string() + " does not exist)");
}

}  // namespace

const fs::path& data_root() {
  static const fs::path folder = find_data_root();
  return folder;
}

}  // namespace trammel::harness

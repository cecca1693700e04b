#include <boost/uuid/name_generator_sha1.hpp>
#include <boost/uuid/uuid_io.hpp>

#include "harness/base/environment.h"
#include "harness/base/errors.h"
#include "harness/base/json_file.h"

namespace trammel::harness {

std::string content_hash(const std::string& text) {
  return boost::uuids::to_string(boost::uuids::name_generator_sha1(boost::uuids::ns::oid())(text));
}

std::string file_hash(const std::filesystem::path& file) {
  try {
    return content_hash(read_text(file));
  } catch (const InputError&) {
    return {};
  }
}

std::string program_hash() {
  return content_hash(read_text("/proc/self/exe"));
}

}  // namespace trammel::harness

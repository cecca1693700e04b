#include <link.h>

#include <boost/uuid/name_generator_sha1.hpp>
#include <boost/uuid/uuid_io.hpp>

#include "harness/base/environment.h"
#include "harness/base/errors.h"
#include "harness/base/json_file.h"

namespace trammel::harness {
namespace {

/// Appends the ELF notes of the first loaded object, which is the program itself. One of them is
/// the build id. This is a callback of dl_iterate_phdr.
int append_notes(dl_phdr_info* object, std::size_t, void* notes) {
  for (int i = 0; i < object->dlpi_phnum; ++i) {
    const ElfW(Phdr)& part = object->dlpi_phdr[i];
    // NOLINTNEXTLINE(performance-no-int-to-ptr): the loader reports addresses as integers
    const char* at = reinterpret_cast<const char*>(object->dlpi_addr + part.p_vaddr);
    if (part.p_type == PT_NOTE) static_cast<std::string*>(notes)->append(at, part.p_memsz);
  }
  return 1;
}

}  // namespace

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
  std::string notes;
  dl_iterate_phdr(append_notes, &notes);
  return content_hash(notes);
}

}  // namespace trammel::harness

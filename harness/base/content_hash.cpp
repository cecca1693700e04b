#include <link.h>

#include <boost/uuid/name_generator_sha1.hpp>
#include <boost/uuid/uuid_io.hpp>

#include "harness/base/environment.h"

namespace trammel::harness {

std::string content_hash(const std::string& text) {
  return boost::uuids::to_string(boost::uuids::name_generator_sha1(boost::uuids::ns::oid())(text));
}

std::string program_hash() {
  dl_phdr_info program{};  // data of the first loaded object: the program itself
  // The callback only copies a structure, because its caller is a C function, which must not
  // receive exceptions.
  const auto copy_first = [](dl_phdr_info* object, std::size_t, void* copy) {
    *static_cast<dl_phdr_info*>(copy) = *object;
    return 1;
  };
  dl_iterate_phdr(copy_first, &program);
  std::string notes;  // one of the ELF notes is the build id
  for (int i = 0; i < program.dlpi_phnum; ++i) {
    const ElfW(Phdr)& segment = program.dlpi_phdr[i];
    // NOLINTNEXTLINE(performance-no-int-to-ptr): the loader reports addresses as integers
    const char* start = reinterpret_cast<const char*>(program.dlpi_addr + segment.p_vaddr);
    if (segment.p_type == PT_NOTE) notes.append(start, segment.p_memsz);
  }
  return content_hash(notes);
}

}  // namespace trammel::harness

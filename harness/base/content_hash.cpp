#include <link.h>

#include <boost/uuid/name_generator_sha1.hpp>
#include <boost/uuid/uuid_io.hpp>
#include <cstring>

#include "harness/base/environment.h"
#include "harness/base/errors.h"
#include "harness/base/json_file.h"

namespace trammel::harness {
namespace {

/// Reads the build id from the ELF notes of the first loaded object, which is the program itself.
/// This is a callback of dl_iterate_phdr.
int take_build_id(dl_phdr_info* object, std::size_t, void* build_id) {
  for (int i = 0; i < object->dlpi_phnum; ++i) {
    const ElfW(Phdr)& part = object->dlpi_phdr[i];
    if (part.p_type != PT_NOTE) continue;
    // NOLINTNEXTLINE(performance-no-int-to-ptr): the loader reports addresses as integers
    const char* at = reinterpret_cast<const char*>(object->dlpi_addr + part.p_vaddr);
    const char* const end = at + part.p_memsz;
    const auto padded = [&](std::size_t size) {
      return (size + part.p_align - 1) / part.p_align * part.p_align;
    };
    while (at + sizeof(ElfW(Nhdr)) <= end) {
      ElfW(Nhdr) note;
      std::memcpy(&note, at, sizeof note);
      const char* const name = at + sizeof note;
      const char* const content = name + padded(note.n_namesz);
      const bool gnu = note.n_namesz == sizeof "GNU" && std::memcmp(name, "GNU", sizeof "GNU") == 0;
      if (gnu && note.n_type == NT_GNU_BUILD_ID)
        static_cast<std::string*>(build_id)->assign(content, note.n_descsz);
      at = content + padded(note.n_descsz);
    }
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
  std::string build_id;
  dl_iterate_phdr(take_build_id, &build_id);
  return build_id.empty() ? file_hash("/proc/self/exe") : content_hash(build_id);
}

}  // namespace trammel::harness

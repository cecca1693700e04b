# Writes OUTPUT, a C++ source that holds the text of FILES by their names: see templates.h.
set(source "#include \"reports/text/templates.h\"\n\n#include <map>\n#include <stdexcept>\n
namespace trammel::reports {\n
const std::string& template_text(const std::string& name) {
  static const std::map<std::string, std::string> texts = {\n")
foreach(file IN LISTS FILES)
  get_filename_component(name "${file}" NAME)
  file(READ "${file}" text)
  string(APPEND source "{\"${name}\", R\"trammel(${text})trammel\"},\n")
endforeach()
string(APPEND source "};
  const auto found = texts.find(name);
  if (found == texts.end()) throw std::logic_error(\"no template \" + name);
  return found->second;
}\n
}  // namespace trammel::reports\n")
file(WRITE "${OUTPUT}" "${source}")

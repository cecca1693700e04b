# Writes OUTPUT, a C++ source that holds the text of FILES by their names, in the FUNCTION that HEADER declares.
set(source "#include \"${HEADER}\"\n\n#include <map>\n#include <stdexcept>\n
const std::string& ${FUNCTION}(const std::string& name) {
  static const std::map<std::string, std::string> texts = {\n")
foreach(file IN LISTS FILES)
  get_filename_component(name "${file}" NAME)
  file(READ "${file}" text)
  string(APPEND source "{\"${name}\", R\"trammel(${text})trammel\"},\n")
endforeach()
string(APPEND source "};
  const auto found = texts.find(name);
  if (found == texts.end()) throw std::logic_error(\"no text \" + name);
  return found->second;
}\n")
file(WRITE "${OUTPUT}" "${source}")

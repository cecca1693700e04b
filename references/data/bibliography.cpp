#include "references/data/bibliography.h"

#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "references/data/reference.h"

namespace trammel::references {

Bibliography load_bibliography(const std::filesystem::path& file) {
  Bibliography sources;
  std::ifstream in(file);
  if (!in) return sources;
  try {
    const std::string text(std::istreambuf_iterator<char>(in), {});
    const nlohmann::json json = nlohmann::json::parse(text);
    for (const auto& item : json.items()) {
      sources[item.key()] = {item.value().at("text").get<std::string>(),
                             item.value().value("doi", "")};
    }
  } catch (const nlohmann::json::exception& error) {
    throw ReferenceError(file.string() + ": /: expected keys with 'text' and 'doi' (" +
                         error.what() + ")");
  }
  return sources;
}

}  // namespace trammel::references

#include "references/data/bibliography.h"

#include <nlohmann/json.hpp>

#include "references/data/reference.h"

namespace trammel::references {

Source read_source(std::string_view json, const std::string& place) {
  try {
    const nlohmann::json source = nlohmann::json::parse(json);
    return {source.at("text").get<std::string>(), source.value("doi", "")};
  } catch (const nlohmann::json::exception& error) {
    throw ReferenceError(place + ": expected 'text' and 'doi' (" + error.what() + ")");
  }
}

}  // namespace trammel::references

#pragma once

#include <optional>
#include <string>

#include "harness/base/json.h"

/// Checking documents against the JSON Schemas of cases/schema.
namespace trammel::harness {

/// What is wrong, and where.
struct SchemaFault {
  std::string pointer;  ///< JSON pointer into the document; empty: the document itself
  std::string message;  ///< "expected ... (got ...)"
};

/// The deepest fault of a document, empty when it obeys the schema.
/// @param schema  "case", "cost", "reference" or "results"
[[nodiscard]] std::optional<SchemaFault> find_schema_fault(const Json& document,
                                                           const std::string& schema);

}  // namespace trammel::harness

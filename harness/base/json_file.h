#pragma once

#include <filesystem>
#include <string>

#include "harness/base/json.h"

namespace trammel::harness {

/// Returns the content of a file.
/// @throws InputError  if the file cannot be read, is not a regular file or exceeds 256 MiB.
[[nodiscard]] std::string read_text(const std::filesystem::path& file);

/// Reads one JSON document strictly: UTF-8, no duplicate keys, no number beyond a double.
/// @throws InputError  if the text is not JSON (with line and column), or contains a duplicate key
///   or a number that is too large (with the JSON pointer).
[[nodiscard]] Json read_json(const std::filesystem::path& file);

/// Reads a JSON document from a text in memory; messages show `name` as the file.
[[nodiscard]] Json parse_json(const std::string& text, const std::string& name);

/// Reads CBOR (RFC 8949) as JSON. `Json::from_cbor` is slower, because it copies growing objects.
[[nodiscard]] Json parse_cbor(const std::string& bytes);

/// Formats JSON for people and for diffs: objects over several lines, flat arrays on one line.
/// @param max_multiline_depth  nesting level d from which on arrays are written on one line.
///   Objects are written on one line from the level d - 1 on.
[[nodiscard]] std::string format_json(const Json& json, std::size_t max_multiline_depth = 1000);

/// Writes the complete file or nothing: the text is written into a temporary file in the same
/// folder, which is then renamed. Pipes and devices are written directly.
/// @throws InputError  if the folder or file cannot be written.
void write_file(const std::filesystem::path& file, const std::string& text);

}  // namespace trammel::harness

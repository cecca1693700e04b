#pragma once

#include <filesystem>
#include <string>

#include "harness/base/json.h"

namespace trammel::harness {

/// All of a file.
/// @throws InputError  where it cannot be read, is no regular file or has more than 256 MiB.
[[nodiscard]] std::string read_text(const std::filesystem::path& file);

/// Reads one JSON document, strictly: UTF-8, no duplicate keys, no number beyond a double.
/// @throws InputError  with line and column where the text is not JSON, with the JSON pointer of a
///                     key that stands twice or a number that is too large.
[[nodiscard]] Json read_json(const std::filesystem::path& file);

/// The same for a text in memory; `name` stands in for the file in messages.
[[nodiscard]] Json parse_json(const std::string& text, const std::string& name);

/// The same for CBOR (RFC 8949), faster than by `Json::from_cbor`, which copies growing objects.
[[nodiscard]] Json parse_cbor(const std::string& bytes);

/// JSON for people and for diffs: objects over several lines, arrays of plain values on one.
/// @param deepest  what is nested deeper stands in one line, and objects that are one level above
/// it
[[nodiscard]] std::string pretty(const Json& json, std::size_t deepest = 1000);

/// Writes all of it or nothing: into a temporary file beside it, then renamed. What is no file, as
/// a pipe or a device, is written to.
/// @throws InputError  where the folder or file cannot be written.
void write_file(const std::filesystem::path& file, const std::string& text);

}  // namespace trammel::harness

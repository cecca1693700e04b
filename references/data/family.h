#pragma once

#include <map>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// Reads family files. A family file contains the references of one family of cases, each under its
/// id. Keys that most of these references have in common are stated only once, under "common".
namespace trammel::references {

/// Key of the object in a family file that contains the keys that its references have in common.
inline constexpr std::string_view kCommon = "common";

/// Returns true if a key of a family file is the id of a reference.
[[nodiscard]] bool is_reference_id(std::string_view key);

/// Member of a JSON object: key and value as texts.
struct JsonMember {
  std::string_view key;  ///< key without quotes
  std::string_view value;
};

/// Splits a JSON object into its members. The values of the members are not parsed, because a case
/// needs few references of a family.
/// @returns the members, sorted by key; no value if the text is no object or a key is repeated.
[[nodiscard]] std::optional<std::vector<JsonMember>> json_members(std::string_view text);

/// Returns the keys of a JSON object without parsing it: the first key, and each key that follows a
/// line "  },". With the usual line breaks of a family file, these are all its keys. This function
/// takes a tenth of the time of `json_members`.
[[nodiscard]] std::vector<std::string_view> top_level_keys(std::string_view text);

/// Returns the value of a key, or no value if there is no member with this key.
[[nodiscard]] std::optional<std::string_view> find_member(const std::vector<JsonMember>& members,
                                                          std::string_view key);

/// Adds the common keys of a family to a reference that lacks them. If both the common keys and the
/// reference contain a derivation, the keys of the two derivations are merged.
[[nodiscard]] nlohmann::json merge_common_keys(const nlohmann::json& common,
                                               nlohmann::json reference);

/// Reads the references of a family file by id.
/// @throws ReferenceError  if the file is not a JSON object of objects, or if a key is repeated.
[[nodiscard]] std::map<std::string, nlohmann::json> read_family(const std::string& file);

/// Returns the JSON files below a folder, each with its name without ".json"; none if the folder is
/// absent. The function uses readdir, because std::filesystem needs 7,000 instructions per file,
/// and every command lists these files when it starts.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> json_files(
    const std::string& folder);

/// Content of a file in a buffer that is not initialized. Initializing a string would take longer
/// than reading the file.
struct FileText {
  std::unique_ptr<char[]> bytes;
  std::string_view text;
};

/// Reads a file. The text is empty if the file is absent or cannot be read.
[[nodiscard]] FileText read_file(const std::string& file);

}  // namespace trammel::references

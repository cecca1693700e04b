#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "harness/input/json_view.h"
#include "references/data/family.h"
#include "references/data/reference.h"

namespace trammel::harness {

/// Reference values and their bibliographic source.
struct CitedReference {
  references::Reference reference;
  references::Source source;
};

/// Library of reference values by id. Each reference is read once: from references.json next to the
/// case file, else from the catalogue. The place of a reference is the text "FILE#/ID".
class References {
 public:
  /// @param id  value of a document that is the id of a reference
  /// @throws InputError  if the reference is missing, is defined in two files, or is malformed.
  [[nodiscard]] const references::Reference& get(const JsonView& id) const;

  /// Reads the reference at a place "FILE#/ID".
  /// @throws InputError  if the reference is missing or malformed.
  const references::Reference& add(const std::string& place) const;

  /// Returns the place "FILE#/ID" of every reference in the catalogue, by id.
  /// @throws InputError  if a file is malformed or two files contain the same id.
  [[nodiscard]] std::map<std::string, std::string> catalogue() const;

  /// Returns the content hash of each requested reference, by place; empty for missing references.
  [[nodiscard]] std::map<std::string, std::string> hashes() const;
  /// Returns the content hash of a reference, including data shared by the references of its file.
  [[nodiscard]] std::string hash(const std::string& place) const;

  /// Returns all references that have been requested, by id.
  [[nodiscard]] std::map<std::string, CitedReference> requested_references() const;

 private:
  /// Text of a file with several references. The text is split into references on first use.
  struct Family {
    references::FileText file;
    std::optional<std::vector<references::JsonMember>> members;
  };

  struct Key {
    std::string_view key;
    const std::string* file;
  };

  [[nodiscard]] const std::vector<std::string>& catalogue_files() const;
  [[nodiscard]] const std::vector<Key>& catalogue_keys() const;
  [[nodiscard]] Family& family(const std::string& file) const;
  /// @throws InputError  if the file is malformed.
  [[nodiscard]] const std::vector<references::JsonMember>& members(const std::string& file) const;
  [[nodiscard]] bool exists(const std::string& file) const;
  [[nodiscard]] bool has(const std::string& file, const std::string& id) const;
  /// Returns the place "FILE#/ID" of the reference that a case names.
  /// @throws InputError  if no reference has this name.
  [[nodiscard]] std::string find(const std::string& name, const std::string& case_file,
                                 const JsonView& id) const;
  /// Returns the bibliographic source with the given key: from the bibliography in the folder of
  /// the reference's file, else from the bibliography of the catalogue.
  [[nodiscard]] references::Source source(const std::string& key, const std::string& file) const;
  /// Returns the place "FILE#/ID" of a reference of the catalogue; empty if no file has the id.
  [[nodiscard]] std::string find_in_catalogue(const std::string& id) const;
  [[nodiscard]] CitedReference read(const std::string& place) const;

  mutable std::vector<std::string> catalogue_files_;
  mutable std::vector<Key> catalogue_keys_;
  mutable std::map<std::string, Family> families_;
  mutable std::map<std::pair<std::string, std::string>, std::string> places_;  // by case file, id
  mutable std::map<std::string, CitedReference> read_;                         // by place
  mutable std::set<std::string> absent_;  // places without a reference
};

}  // namespace trammel::harness

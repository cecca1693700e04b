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

/// A reference together with its source.
struct CitedReference {
  references::Reference reference;
  references::Source source;
};

/// References by id, each read once: from references.json next to the case file, else from the
/// catalogue. The place of a reference is its file and its JSON pointer: "FILE#/ID".
class References {
 public:
  /// @param id  value of a document that is the id of a reference
  /// @throws InputError  if the reference is missing, is defined in two files, or is malformed.
  [[nodiscard]] const references::Reference& get(const JsonView& id) const;

  /// Reads the reference at a place.
  /// @throws InputError  if it is missing or malformed.
  const references::Reference& add(const std::string& place) const;

  /// Returns the places of the catalogue's references by id.
  /// @throws InputError  if a file is malformed or contains an id of another file.
  [[nodiscard]] std::map<std::string, std::string> catalogue() const;

  /// Returns a hash for each place requested so far; empty for places without a reference.
  [[nodiscard]] std::map<std::string, std::string> hashes() const;
  /// Returns the hash of a reference, including the data shared by its family.
  [[nodiscard]] std::string hash(const std::string& place) const;

  /// Returns all references requested so far, by id.
  [[nodiscard]] std::map<std::string, CitedReference> used() const;

 private:
  /// A file with a family of references, read once and split on first use.
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
  /// Returns the place of a case's reference.
  /// @throws InputError  if there is none.
  [[nodiscard]] std::string find(const std::string& name, const std::string& case_file,
                                 const JsonView& id) const;
  /// Returns the source of a key: from the bibliography next to the reference's file, else from
  /// that of the catalogue.
  [[nodiscard]] references::Source source(const std::string& key, const std::string& file) const;
  /// Returns the place of a reference of the catalogue, or "" if there is none.
  [[nodiscard]] std::string find_in_catalogue(const std::string& id) const;
  [[nodiscard]] CitedReference read(const std::string& place) const;

  mutable std::vector<std::string> catalogue_files_;
  mutable std::vector<Key> catalogue_keys_;
  mutable std::map<std::string, Family> families_;
  mutable std::map<std::pair<std::string, std::string>, std::string> places_;  // by case and id
  mutable std::map<std::string, CitedReference> read_;                         // by place
  mutable std::set<std::string> absent_;  // places that were searched without success
};

}  // namespace trammel::harness

#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "harness/input/json_view.h"
#include "references/data/bibliography.h"
#include "references/data/reference.h"

namespace trammel::harness {

/// A reference with what its source key stands for.
struct CitedReference {
  references::Reference reference;
  references::Source source;
};

/// References by name, read once: from beside the case file, else from the catalogue.
class References {
 public:
  /// @param id      a place that holds the name
  /// @throws InputError  where there is no such reference or its file is broken.
  [[nodiscard]] const references::Reference& get(const JsonView& id) const;

  /// The one in a file. @throws InputError  where it is broken.
  const references::Reference& add(const std::filesystem::path& file) const;

  /// Hash of every file that was looked for so far, empty for one that is not there.
  [[nodiscard]] std::map<std::string, std::string> hashes() const;

  /// All that were asked for so far, by name.
  [[nodiscard]] std::map<std::string, CitedReference> used() const;

 private:
  [[nodiscard]] CitedReference read(const std::filesystem::path& file) const;
  /// The source of a key: of the bibliography beside the reference's file, else of the catalogue's.
  [[nodiscard]] references::Source source(const std::string& key,
                                          const std::filesystem::path& file) const;

  mutable std::vector<std::string> rooms_;  // folders of the catalogue's references, listed once
  mutable std::map<std::filesystem::path, references::Bibliography> bibliographies_;
  mutable std::map<std::filesystem::path, CitedReference> read_;
  mutable std::set<std::filesystem::path> absent_;  // looked for in vain
};

}  // namespace trammel::harness

#pragma once

#include <string>
#include <utility>
#include <vector>

#include "harness/base/json.h"
#include "solver/model/model.h"

namespace trammel::harness {

/// Materials and sections of a built model as a case file has them: each once, by name.
class SectionTable {
 public:
  /// @param known  materials of the case with their names, which are kept where a section is made
  ///               of one to round-off
  explicit SectionTable(std::vector<std::pair<std::string, solver::Material>> known)
      : materials_(std::move(known)), used_(materials_.size(), false) {}

  /// The name that the section has from now on. Area, second moment, shear coefficient and half
  /// depth are those that give its stiffnesses again to the last bit, where there are such.
  [[nodiscard]] std::string name_of(const solver::Section& section);
  [[nodiscard]] std::string name_of(const solver::Material& material);

  [[nodiscard]] Json materials() const;
  [[nodiscard]] const Json& sections() const { return sections_; }

 private:
  [[nodiscard]] solver::Material material_of(const solver::Section& section) const;

  std::vector<std::pair<std::string, solver::Material>> materials_;
  std::vector<bool> used_;
  Json sections_ = Json::object();
};

}  // namespace trammel::harness

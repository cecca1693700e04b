#pragma once

#include <string>

#include "solver/model/model.h"

/// What a sentence calls a part of the model: its name, or its number where it has none.
namespace trammel::solver {

[[nodiscard]] std::string node_label(const Model& model, Index node);
[[nodiscard]] std::string member_label(const Model& model, Index member);
[[nodiscard]] std::string part_label(const char* kind, const std::string& name, std::size_t index);

}  // namespace trammel::solver

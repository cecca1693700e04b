#pragma once

#include <string>

#include "harness/input/json_view.h"
#include "solver/manipulator/frequency_sensitivity.h"

/// Numbers of the manipulator's design, as cases name them.
namespace trammel::harness {

/// {"property": "length", "links": ["A1-B1", ...], "platform": false}
/// @throws InputError  where it names no number: the length or width of a platform alone.
[[nodiscard]] solver::DesignParameter read_design_parameter(const JsonView& parameter);

/// "sensitivity_Hz_per_m", by the parameter's unit.
[[nodiscard]] std::string sensitivity_name(solver::DesignParameter::Kind kind);

}  // namespace trammel::harness

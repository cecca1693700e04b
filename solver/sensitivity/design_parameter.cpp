#include "solver/sensitivity/design_parameter.h"

#include <algorithm>

namespace trammel::solver {

using Kind = trammel::solver::DesignParameter::Kind;

namespace {

/// Calls visit(number) for each number of the design that the parameter names.
template <class Visit>
void for_each_number(ManipulatorDesign& design, const DesignParameter& parameter, Visit&& visit) {
  const Kind kind = parameter.kind;
  const bool length = kind == Kind::length;
  const auto meet = [&visit](double* x) {
    if (x != nullptr) visit(*x);
  };
  for (std::size_t i = 0; i < 3; ++i) {
    if (parameter.proximal[i]) {
      meet(length ? &design.geometry.proximal[i] : detail::link_number(design.proximal[i], kind));
    }
    if (parameter.distal[i]) {
      meet(length ? &design.geometry.distal[i] : detail::link_number(design.distal[i], kind));
    }
  }
  if (parameter.platform) meet(detail::number(design.platform, kind));
}

}  // namespace

const char* unit(Kind kind) {
  switch (kind) {
    case Kind::E:
      return "Pa";
    case Kind::density:
      return "kg/m^3";
    case Kind::length:
    case Kind::thickness:
    case Kind::width:
      break;
  }
  return "m";
}

ManipulatorDesign perturbed(const ManipulatorDesign& design, const DesignParameter& parameter,
                            double change) {
  ManipulatorDesign result = design;
  for_each_number(result, parameter, [change](double& x) { x += change; });
  return result;
}

double parameter_value(const ManipulatorDesign& design, const DesignParameter& parameter) {
  ManipulatorDesign copy = design;
  double largest = 0;
  for_each_number(copy, parameter, [&largest](double& x) { largest = std::max(largest, x); });
  return largest;
}

}  // namespace trammel::solver

#include "solver/sensitivity/design_parameter.h"

#include <algorithm>

namespace trammel::solver {

using Quantity = DesignParameter::Quantity;

namespace {

/// Calls visit(number) for each number of the design that the parameter names.
template <class Visit>
void for_each_number(ManipulatorDesign& design, const DesignParameter& parameter, Visit&& visit) {
  const Quantity quantity = parameter.quantity;
  const bool length = quantity == Quantity::length;
  const auto meet = [&visit](double* x) {
    if (x != nullptr) visit(*x);
  };
  for (std::size_t i = 0; i < 3; ++i) {
    if (parameter.proximal[i]) {
      meet(length ? &design.geometry.proximal[i]
                  : detail::link_number(design.proximal[i], quantity));
    }
    if (parameter.distal[i]) {
      meet(length ? &design.geometry.distal[i] : detail::link_number(design.distal[i], quantity));
    }
  }
  if (parameter.platform) meet(detail::number(design.platform, quantity));
}

}  // namespace

const char* unit(Quantity quantity) {
  switch (quantity) {
    case Quantity::E:
      return "Pa";
    case Quantity::density:
      return "kg/m^3";
    case Quantity::length:
    case Quantity::thickness:
    case Quantity::width:
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

#include "harness/export/section_table.h"

#include <array>
#include <cmath>
#include <limits>

#include "solver/model/numbers.h"

namespace trammel::harness {
namespace {

/// A quotient and its neighbours: among them are all x with x * divisor == product.
std::array<double, 3> quotients(double product, double divisor) {
  const double x = product / divisor, beyond = std::numeric_limits<double>::infinity();
  return {x, std::nextafter(x, 0), std::nextafter(x, beyond)};
}

/// x with gives(x), or the first.
template <class Gives>
double first_that(const std::array<double, 3>& candidates, const Gives& gives) {
  for (const double x : candidates)
    if (gives(x)) return x;
  return candidates.front();
}

/// One that both stiffness and rotary inertia are products of, or else the stiffness.
double second_moment(const solver::Section& section, const solver::Material& material) {
  const auto candidates = quotients(section.EI, material.E);
  const auto stiff = [&](double I) { return material.E * I == section.EI; };
  for (const double I : candidates)
    if (stiff(I) && material.rho * I == section.inertia_per_length) return I;
  return first_that(candidates, stiff);
}

double shear_coefficient(const solver::Section& section, const solver::Material& material) {
  const double G = material.E / (2 * (1 + material.nu));
  const auto gives = [&](double k) { return k * G * section.area == section.kappa_GA; };
  constexpr double kRectangle = 5.0 / 6.0;
  if (gives(kRectangle)) return kRectangle;
  return first_that(quotients(section.kappa_GA / section.area, G), gives);
}

bool nearly(double a, double b) {
  return std::abs(a - b) <= 4 * solver::kEps * std::abs(b);
}

}  // namespace

solver::Material SectionTable::material_of(const solver::Section& section) const {
  const double A = section.area, mass = section.mass_per_length;
  solver::Material made;
  for (const auto& [name, material] : materials_) {
    if (!nearly(material.E * A, section.EA)) continue;
    const bool exactly = material.E * A == section.EA;
    if (exactly ? material.rho * A == mass : nearly(material.rho * A, mass)) return material;
    made = material;
  }
  if (made.E == 0) {
    made.E = first_that(quotients(section.EA, A), [&](double E) { return E * A == section.EA; });
  }
  made.rho = first_that(quotients(mass, A), [&](double rho) { return rho * A == mass; });
  return made;
}

std::string SectionTable::name_of(const solver::Material& material) {
  std::size_t i = 0;
  const auto same = [&](const solver::Material& m) {
    return m.E == material.E && m.rho == material.rho && m.nu == material.nu;
  };
  while (i < materials_.size() && !same(materials_[i].second)) ++i;
  if (i == materials_.size()) {
    materials_.emplace_back("material-" + std::to_string(i + 1), material);
    used_.push_back(false);
  }
  used_[i] = true;
  return materials_[i].first;
}

std::string SectionTable::name_of(const solver::Section& section) {
  const solver::Material material = material_of(section);
  Json made = {{"material", name_of(material)},
               {"area_m2", section.area},
               {"second_moment_m4", second_moment(section, material)},
               {"shear_coefficient", shear_coefficient(section, material)}};
  const double I = made["second_moment_m4"].get<double>(), W = section.section_modulus;
  if (I > 0 && W > 0 && std::isfinite(W)) {
    made["half_depth_m"] = first_that(quotients(I, W), [&](double c) { return I / c == W; });
  }
  for (const auto& [name, known] : sections_.items())
    if (known == made) return name;
  std::string name = "section-" + std::to_string(sections_.size() + 1);
  sections_[name] = std::move(made);
  return name;
}

Json SectionTable::materials() const {
  Json materials = Json::object();
  for (std::size_t i = 0; i < materials_.size(); ++i) {
    const auto& [name, material] = materials_[i];
    if (!used_[i]) continue;
    materials[name] = {{"E_Pa", material.E}, {"rho_kg_m3", material.rho}, {"nu", material.nu}};
  }
  return materials;
}

}  // namespace trammel::harness

#pragma once

#include <Eigen/SparseCore>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

/// Physical effects that a model may include. An inactive effect is removed from the model before
/// assembly. An inactive effect therefore causes no degrees of freedom, no matrices and no
/// evaluations.
namespace trammel::solver {

/// Physical effect that a model may include.
enum class Effect : std::uint8_t {
  axial_flexibility,     ///< axial strain of bending members; off: inextensible bending members
  shear,                 ///< shear deformation of members; off: Euler-Bernoulli or Rayleigh beam
  rotary_inertia,        ///< rotary inertia of cross-sections; off: Euler-Bernoulli or shear beam
  platform_flexibility,  ///< elastic platform of a manipulator, made of triangles; off: rigid body
  joint_compliance,      ///< springs between member ends and nodes; off: welded ends
  link_mass,             ///< mass and inertia of the members
  gravity,               ///< weight of all masses
  inertia,               ///< inertia of all masses; off: motion is a sequence of static equilibria
  damping,               ///< dissipative forces that depend on velocities
  gyroscopic,  ///< Coriolis and other forces in rotating frames, except the centrifugal force
  geometric_stiffening,  ///< internal forces rotate with member or plate (second-order theory)
  large_displacement,  ///< equilibrium in the deformed configuration: geometrically exact elements
};
inline constexpr std::size_t kEffectCount = 12;

/// Set of physical effects.
class Effects {
 public:
  constexpr Effects() = default;
  [[nodiscard]] static constexpr Effects all() { return Effects((1U << kEffectCount) - 1); }

  [[nodiscard]] constexpr bool has(Effect effect) const { return (bits_ & bit(effect)) != 0; }
  [[nodiscard]] constexpr Effects with(Effect effect) const { return Effects(bits_ | bit(effect)); }
  [[nodiscard]] constexpr Effects without(Effect effect) const {
    return Effects(bits_ & ~bit(effect));
  }
  [[nodiscard]] constexpr Effects without(Effects removed) const {
    return Effects(bits_ & ~removed.bits_);
  }
  [[nodiscard]] constexpr bool empty() const { return bits_ == 0; }
  [[nodiscard]] std::vector<Effect> list() const;  ///< effects in the order of the enumeration
  friend constexpr bool operator==(Effects a, Effects b) { return a.bits_ == b.bits_; }

 private:
  explicit constexpr Effects(std::uint32_t bits) : bits_(bits) {}
  static constexpr std::uint32_t bit(Effect effect) { return 1U << static_cast<unsigned>(effect); }
  std::uint32_t bits_ = 0;
};

/// Returns the name of an effect in case files, such as "axial-flexibility".
[[nodiscard]] std::string_view name_of(Effect effect);
/// Returns the effect with the given name (as in case files), or an empty value if there is none.
[[nodiscard]] std::optional<Effect> find_effect(std::string_view name);

/// Number of evaluations of element matrices, element loads and springs that each effect causes.
using EffectCounts = std::array<std::int64_t, kEffectCount>;

using SparseMatrix = Eigen::SparseMatrix<double>;

/// Numbers of evaluations, factorizations, solutions and steps during an analysis. The numbers are
/// the same on every machine. Inactive effects cause no evaluations.
struct Counters {
  std::int64_t element_evaluations = 0;  ///< evaluations of element matrices
  std::int64_t factorizations = 0;
  std::int64_t solves = 0;  ///< solved right-hand sides, including iterative refinement
  std::int64_t steps = 0;   ///< time steps or load steps, including rejected steps
  EffectCounts effects{};   ///< evaluations caused by each effect

  void add(Effect effect, std::int64_t evaluations) {
    effects[static_cast<std::size_t>(effect)] += evaluations;
  }
  [[nodiscard]] std::int64_t evaluations(Effect effect) const {
    return effects[static_cast<std::size_t>(effect)];
  }
  Counters& operator+=(const Counters& other);
};

}  // namespace trammel::solver

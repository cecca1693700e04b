#pragma once

#include <Eigen/SparseCore>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

/// What a scene may call for. An effect that is off is taken out of the model before anything is
/// built from it: no degree of freedom, no matrix and no evaluation is left of it.
namespace trammel::solver {

enum class Effect : std::uint8_t {
  axial_flexibility,     ///< members that bend also stretch; off: inextensible, by constraints
  shear,                 ///< shear of the sections; off: Euler-Bernoulli or Rayleigh
  rotary_inertia,        ///< of the sections; off: Euler-Bernoulli or shear beam
  platform_flexibility,  ///< a manipulator's platform of triangles; off: a rigid body
  joint_compliance,      ///< springs between member ends and nodes; off: welded
  link_mass,             ///< mass and inertia of the members
  gravity,               ///< weights
  inertia,               ///< mass at all; off: no mass matrix, motion is a row of equilibria
  damping,               ///< forces that go with velocities and take energy
  gyroscopic,            ///< Coriolis and other forces of frames that turn, but for the centrifugal
  geometric_stiffening,  ///< forces turn with what they act in: second-order theory
  large_displacement,    ///< equilibrium in the place where it is: the geometrically exact tier
};
inline constexpr std::size_t kEffectCount = 12;

/// A set of effects.
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
  [[nodiscard]] std::vector<Effect> list() const;  ///< in the order of the enumeration
  friend constexpr bool operator==(Effects a, Effects b) { return a.bits_ == b.bits_; }

 private:
  explicit constexpr Effects(std::uint32_t bits) : bits_(bits) {}
  static constexpr std::uint32_t bit(Effect effect) { return 1U << static_cast<unsigned>(effect); }
  std::uint32_t bits_ = 0;
};

/// "axial-flexibility", ...; as case files name them.
[[nodiscard]] std::string_view name_of(Effect effect);
[[nodiscard]] std::optional<Effect> effect_named(std::string_view name);

/// Evaluations that effects have caused: element matrices, loads of elements, springs.
using EffectCounts = std::array<std::int64_t, kEffectCount>;

using SparseMatrix = Eigen::SparseMatrix<double>;

/// What was evaluated; the same on every machine, and zero for what a scene does not call for.
struct Counters {
  std::int64_t element_evaluations = 0;  ///< element matrices
  std::int64_t factorizations = 0;
  std::int64_t solves = 0;  ///< right-hand sides, refinement included
  std::int64_t steps = 0;   ///< of time or load, rejected ones included
  EffectCounts effects{};   ///< by effect

  void count(Effect effect, std::int64_t evaluations) {
    effects[static_cast<std::size_t>(effect)] += evaluations;
  }
  [[nodiscard]] std::int64_t evaluations(Effect effect) const {
    return effects[static_cast<std::size_t>(effect)];
  }
  Counters& operator+=(const Counters& other);
};

}  // namespace trammel::solver

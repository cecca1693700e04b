#include "references/numerics/ball.h"

#include <flint/flint.h>

#include <memory>

#include "references/numerics/arguments.h"

namespace trammel::references {

Ball::Ball(const Real& value) : Ball() {
  arb_set_str(x_, value.str(50, std::ios::scientific).c_str(), kBits);
  if (value == trunc(value) && abs(value) < Real(1e6)) return;
  const Ball doubt = abs(*this) / apply(arb_pow, 10, 45);
  arb_add_error(x_, doubt.x_);
}

Ball Ball::middle() const {
  Ball result;
  arb_get_mid_arb(result.x_, x_);
  return result;
}

std::string Ball::digits() const {
  constexpr slong kDigits = 30;
  if (arb_rel_accuracy_bits(x_) < 104)  // 104 bits: 31 digits
    throw DerivationError("the enclosure is too wide to prove 30 digits");
  const std::unique_ptr<char, void (*)(void*)> text(
      arb_get_str(middle().x_, kDigits, ARB_STR_NO_RADIUS | ARB_STR_MORE), flint_free);
  return text.get();
}

Ball::operator int() const {
  fmpz_t integer;
  fmpz_init(integer);
  const bool unique = arb_get_unique_fmpz(integer, x_) != 0 && fmpz_fits_si(integer) != 0;
  const slong value = unique ? fmpz_get_si(integer) : 0;
  fmpz_clear(integer);
  if (!unique) throw DerivationError("the enclosure does not contain exactly one integer");
  return static_cast<int>(value);
}

bool Ball::decide(const Ball& a, const Ball& b, Relation yes, Relation no) {
  if (yes(a.x_, b.x_) != 0) return true;
  if (no(a.x_, b.x_) != 0) return false;
  throw DerivationError("two enclosures overlap, so that neither number is known to be larger");
}

}  // namespace trammel::references

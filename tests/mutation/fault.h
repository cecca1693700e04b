#pragma once

// Header that mutate.py includes before every source. An environment variable activates one fault.

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstdlib>
#include <type_traits>

namespace trammel {
namespace mutation {

inline constexpr int kMost = 4096;
inline unsigned char unlogged[kMost] = {};
inline unsigned char* reached = unlogged;  ///< 1 for each reached fault; forked processes share it
inline int active = -1;
inline double error = 0.01;  ///< relative error of coefficients

inline bool read_environment() {
  if (const char* number = std::getenv("TRAMMEL_FAULT_NUMBER")) active = std::atoi(number);
  if (const char* size = std::getenv("TRAMMEL_FAULT_ERROR")) error = std::atof(size);
  const char* file = std::getenv("TRAMMEL_FAULT_LOG");
  const int log = file ? open(file, O_RDWR) : -1;
  if (log < 0) return false;
  void* bytes = mmap(nullptr, kMost, PROT_READ | PROT_WRITE, MAP_SHARED, log, 0);
  close(log);
  if (bytes != MAP_FAILED) reached = static_cast<unsigned char*>(bytes);
  return true;
}

inline const bool environment_is_read = read_environment();

}  // namespace mutation

inline bool fault(int number) {
  if (mutation::reached[number] == 0) mutation::reached[number] = 1;
  return number == mutation::active;
}

/// Returns the coefficient x of a formula, multiplied by 1 + `mutation::error` if the fault with
/// this number is active. Integers become real numbers.
template <class T>
auto scaled(int number, const T& x) {
  using Number = std::conditional_t<std::is_arithmetic_v<T>, double, T>;
  return fault(number) ? Number(Number(x) * (1 + mutation::error)) : Number(x);
}

/// Factor that mutate.py inserts before the operand of a + or -. Its value is `whole` (1, or -1
/// after an inserted sign) if the fault with this number is inactive. If the fault is active, its
/// value is `size` (-1, 0 or 1).
struct Factor {
  int number, size, whole = 1;
};
template <class T>
auto operator*(Factor factor, const T& x) {
  using Number = std::conditional_t<std::is_arithmetic_v<T>, T, double>;
  return Number(fault(factor.number) ? factor.size : factor.whole) * x;
}

/// Switch that is inserted after * or /: the operand x becomes 1 / x if the fault is active.
/// Integers are refused, because they are indices.
struct Reciprocal {
  int number;
};
template <class T>
T operator->*(Reciprocal reciprocal, const T& x) {
  static_assert(!std::is_integral_v<T>);
  return fault(reciprocal.number) ? T(1.0 / x) : x;
}

/// Switch that mutate.py inserts in a comparison as `a < Compared{n} < b`. If fault n is active,
/// the operators < and <= are exchanged. The operators > and >=, and == and !=, are exchanged
/// likewise.
struct Compared {
  int number;
};
template <class T>
struct ComparedLeft {
  const T& x;
  int number;
};
#define TRAMMEL_COMPARISON(is, other)                            \
  template <class A>                                             \
  ComparedLeft<A> operator is(const A& a, Compared compared) {   \
    return {a, compared.number};                                 \
  }                                                              \
  template <class A, class B>                                    \
  bool operator is(const ComparedLeft<A>& a, const B& b) {       \
    return fault(a.number) ? bool(a.x other b) : bool(a.x is b); \
  }
TRAMMEL_COMPARISON(<, <=)
TRAMMEL_COMPARISON(<=, <)
TRAMMEL_COMPARISON(>, >=)
TRAMMEL_COMPARISON(>=, >)
TRAMMEL_COMPARISON(==, !=)
TRAMMEL_COMPARISON(!=, ==)
#undef TRAMMEL_COMPARISON

}  // namespace trammel

#pragma once

// What mutate.py includes before every source: faults, of which the environment switches one on.

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstdlib>
#include <type_traits>

namespace trammel {
namespace mutation {

inline constexpr int kMost = 4096;
inline unsigned char unlogged[kMost] = {};
inline unsigned char* reached = unlogged;  ///< a byte for each fault; shared with forked processes
inline int active = -1;
inline double error = 0.01;  ///< relative, of coefficients

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

/// A coefficient, or with the fault 1 + error times as much. Whole numbers stand for real ones.
template <class T>
auto scaled(int number, const T& x) {
  using Number = std::conditional_t<std::is_arithmetic_v<T>, double, T>;
  return fault(number) ? Number(Number(x) * (1 + mutation::error)) : Number(x);
}

}  // namespace trammel

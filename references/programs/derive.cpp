#include <iostream>

#include "references/programs/program.h"

int main(int argc, char** argv) {
  return trammel::references::derive_command({argv + 1, argv + argc}, std::cout, std::cerr);
}

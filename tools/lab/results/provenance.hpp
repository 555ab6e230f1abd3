#pragma once

#include <string>

namespace aisle::lab {

/// What a program was built from and how, for files of results.
struct Provenance {
  std::string commit;      // "4c2e91a", "-dirty" after it when files differed
  std::string compiler;    // "GCC 12.2.0"
  std::string build_type;  // "Release"
  std::string flags;       // of the compiler, "-O2"
  std::string vectors;  // of the local planner on this machine: "avx2", "sse2", or "off"; figures do not depend on it
};

/// Of this program, on this machine.
Provenance provenance();

}  // namespace aisle::lab

// How much a run of the tests is to prove.
#pragma once

#include <cstdlib>
#include <string_view>

namespace omma {

/// The environment variable OMMA_FULL_PROOF=1 asks for thousands or millions of cases where a few do for every day.
inline bool full_proof() {
  const char* full = std::getenv("OMMA_FULL_PROOF");
  return full != nullptr && std::string_view(full) == "1";
}

}  // namespace omma

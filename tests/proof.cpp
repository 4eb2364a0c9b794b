#include "tests/proof.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <iostream>
#include <string>
#include <string_view>

namespace omma {
namespace {

class SayWhatIsProved : public ::testing::Environment {
  void SetUp() override {
    if (full_proof()) {
      std::cout << "The full proof\n";
    } else {
      std::cout << "The proof of day " << proof_day() << " of " << proof_days << " (OMMA_PROOF_DAY=" << proof_day()
                << " runs it again)\n";
    }
  }
};

[[maybe_unused]] const auto* const say_what_is_proved = ::testing::AddGlobalTestEnvironment(new SayWhatIsProved);

}  // namespace

bool full_proof() {
  const char* full = std::getenv("OMMA_FULL_PROOF");
  return full != nullptr && std::string_view(full) == "1";
}

size_t proof_day() {
  if (const char* day = std::getenv("OMMA_PROOF_DAY")) return std::stoul(day) % proof_days;
  const auto today = std::chrono::floor<std::chrono::days>(std::chrono::system_clock::now());
  return size_t(today.time_since_epoch().count()) % proof_days;
}

bool is_proved_today(size_t row, size_t column, size_t columns) {
  return full_proof() || is_of_day(proof_day(), row, column, columns);
}

}  // namespace omma

// Runs the real tool, in a folder of the test's own, and says what came of it.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace omma {

struct ToolResult {
  int exit_code = -1;  ///< 128 + signal when it was killed
  std::string out, err;
};

struct ToolLimits {
  std::vector<std::pair<std::string, std::string>> environment;  ///< set beside what there is
  long file_bytes = 0;    ///< no file may grow beyond, as on a full disk; 0: no limit
  int kill_after_ms = 0;  ///< 0: never
};

class ToolTest : public testing::Test {
 protected:
  void SetUp() override;
  void TearDown() override;

  /// Runs `omma` with these words in the test's folder.
  ToolResult run(const std::vector<std::string>& words, const ToolLimits& limits = {}) const;

  /// Expects an exit code, every fragment in standard error, and that the folder's files are as before.
  void expect_refusal(const std::vector<std::string>& words, int exit_code, const std::vector<std::string>& fragments,
                      const ToolLimits& limits = {}) const;

  std::filesystem::path file(const std::string& name) const { return folder_ / name; }
  void write(const std::string& name, const std::string& content) const;
  /// Names of all files in the folder, hidden ones included, sorted.
  std::vector<std::string> files() const;

 private:
  std::filesystem::path folder_;   ///< where the tool runs
  std::filesystem::path streams_;  ///< what it prints
};

}  // namespace omma

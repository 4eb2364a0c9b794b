#include "tests/cli/tool.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>

#include "omma/base/file.h"
#include "tests/places.h"

namespace omma {
namespace fs = std::filesystem;

namespace {

/// In the child: nothing but system calls and the exec.
[[noreturn]] void become_tool(char* const* words, const fs::path& folder, const fs::path& out, const fs::path& err,
                              const ToolLimits& limits) {
  for (const auto& [name, value] : limits.environment) ::setenv(name.c_str(), value.c_str(), 1);
  if (limits.file_bytes > 0) {
    const rlimit limit{rlim_t(limits.file_bytes), rlim_t(limits.file_bytes)};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    std::signal(SIGXFSZ, SIG_IGN);  // the write fails instead, as on a full disk
  }
  ::dup2(::open("/dev/null", O_RDONLY), STDIN_FILENO);
  ::dup2(::open(out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), STDOUT_FILENO);
  ::dup2(::open(err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), STDERR_FILENO);
  if (::chdir(folder.c_str()) == 0) ::execv(places::tool, words);
  ::_exit(127);
}

}  // namespace

void ToolTest::SetUp() {
  const fs::path base = fs::temp_directory_path() / fmt::format("omma_cli_{}", ::getpid());
  folder_ = base / "work";
  streams_ = base / "streams";
  fs::create_directories(folder_);
  fs::create_directories(streams_);
}

void ToolTest::TearDown() { fs::remove_all(folder_.parent_path()); }

ToolResult ToolTest::run(const std::vector<std::string>& words, const ToolLimits& limits) const {
  std::vector<std::string> all{"omma"};
  all.insert(all.end(), words.begin(), words.end());
  std::vector<char*> pointers;
  for (std::string& word : all) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  const fs::path out = streams_ / "out", err = streams_ / "err";
  const pid_t child = ::fork();
  if (child == 0) become_tool(pointers.data(), folder_, out, err, limits);
  if (limits.kill_after_ms > 0) {
    ::usleep(unsigned(limits.kill_after_ms) * 1000);
    ::kill(child, SIGKILL);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return {code, read_file(out), read_file(err)};
}

void ToolTest::expect_refusal(const std::vector<std::string>& words, int exit_code,
                              const std::vector<std::string>& fragments, const ToolLimits& limits) const {
  SCOPED_TRACE(fmt::format("omma {}", fmt::join(words, " ")));
  const std::vector<std::string> before = files();
  const ToolResult result = run(words, limits);
  EXPECT_EQ(result.exit_code, exit_code) << result.err;
  for (const std::string& fragment : fragments) {
    EXPECT_NE(result.err.find(fragment), std::string::npos) << "'" << fragment << "' is missing in: " << result.err;
  }
  EXPECT_EQ(files(), before);
}

void ToolTest::write(const std::string& name, const std::string& content) const { write_text(file(name), content); }

std::vector<std::string> ToolTest::files() const {
  std::vector<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(folder_)) {
    names.push_back(fs::relative(entry.path(), folder_).string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace omma

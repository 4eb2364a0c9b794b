// The command line: commands, their options, what they call. CLI11 reads the words; it stays behind this header, for it
// takes seconds to compile in every file that includes it.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace omma::tool {

/// An option's value as it was typed; empty when it was not given.
using Text = std::optional<std::string>;

/// What is said of an option where it is declared: add_option(…).type_name("PX").group("Picture").
class Option {
 public:
  explicit Option(CLI::Option* option) : option_(option) {}

  /// What stands for its value in --help.
  const Option& type_name(const std::string& name) const;
  /// The heading it is listed under.
  const Option& group(const std::string& heading) const;
  const Option& required() const;
  /// It takes the one word behind it. Without this, an option of several values takes all that follow.
  const Option& one_word() const;
  /// One word holds several values with this between them.
  const Option& delimiter(char character) const;
  const Option& excludes(const std::string& other) const;

 private:
  CLI::Option* option_;
};

/// A command while it is declared. What options write into lives as long as the program.
class Command {
 public:
  explicit Command(CLI::App* app) : app_(app) {}

  Command add_command(const std::string& name, const std::string& description) const;
  /// `names` are "--size", "-o,--output", or "SCENE" for a word by its place.
  Option add_option(const std::string& names, std::string& value, const std::string& description) const;
  Option add_option(const std::string& names, Text& value, const std::string& description) const;
  Option add_option(const std::string& names, std::vector<std::string>& values, const std::string& description) const;
  Option add_flag(const std::string& names, bool& value, const std::string& description) const;
  void set_version(const std::string& text) const;
  /// What --help ends with.
  void footer(const std::string& text) const;
  /// Called once all words are read.
  void callback(std::function<void()> function) const;
  /// Every word behind the command, --help too, is another's: none is read here, the callback is given them all.
  void pass_words_on(std::function<void(std::vector<std::string>)> function) const;

 protected:
  CLI::App* app_;
};

/// Ends the program with this code, everything worth saying having been said.
struct ExitCode {
  int code;
};

class Program : public Command {
 public:
  Program(const std::string& name, const std::string& description);
  ~Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  /// One of the commands must be given; without any word the help is printed.
  void require_command();
  /// Reads the words and calls what they ask for; what goes wrong is said on standard error, the nearest name with it.
  /// Returns the exit code.
  int run(int argc, char** argv);

 private:
  std::unique_ptr<CLI::App> owned_;
  bool needs_command_ = false;
};

}  // namespace omma::tool

#include "command_line.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <new>

#include "omma/base/error.h"
#include "omma/base/names.h"

namespace omma::tool {
namespace {

bool is_option(const std::string& word) { return word.size() > 1 && word[0] == '-'; }

bool is_negative_number(const std::string& word) {
  return is_option(word) && (word[1] == '.' || (word[1] >= '0' && word[1] <= '9'));
}

/// "--from" of "--from=1,2,3", "-o" of "-oa.png".
std::string option_name(const std::string& word) {
  return word.starts_with("--") ? word.substr(0, word.find('=')) : word.substr(0, 2);
}

void require_option(const CLI::App& command, const std::string& word) {
  const std::string name = option_name(word);
  if (command.get_option_no_throw(name)) return;
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& known : option->get_lnames()) names.push_back("--" + known);
    for (const std::string& known : option->get_snames()) names.push_back("-" + known);
  }
  throw CommandError("{}", unknown_name("option", name, names));
}

const CLI::App& require_subcommand(const CLI::App& tool, const std::string& word) {
  std::vector<std::string> names;
  for (const CLI::App* command : tool.get_subcommands(nullptr)) {
    if (command->get_name() == word) return *command;
    names.push_back(command->get_name());
  }
  throw CommandError("{}", unknown_name("command", word, names));
}

/// What CLI11 leaves to be desired: a negative number after an option is joined to it (`--from -3,1,2` becomes
/// `--from=-3,1,2`), and an unknown command or option throws CommandError with the nearest name.
std::vector<std::string> checked_words(const CLI::App& tool, const std::vector<std::string>& words) {
  std::vector<std::string> arguments;
  const CLI::App* command = &tool;
  const bool has_subcommands = !tool.get_subcommands(nullptr).empty();
  for (const std::string& word : words) {
    if (command->get_prefix_command()) {  // these are another program's
      arguments.push_back(word);
      continue;
    }
    if (is_negative_number(word)) {
      // A long option takes its value after '=', a short one right behind its letter.
      if (!arguments.empty() && is_option(arguments.back()) && arguments.back().find('=') == std::string::npos) {
        arguments.back() += (arguments.back().starts_with("--") ? "=" : "") + word;
        continue;
      }
    } else if (is_option(word)) {
      require_option(*command, word);
    } else if (command == &tool && has_subcommands) {
      command = &require_subcommand(tool, word);
    }
    arguments.push_back(word);
  }
  return arguments;
}

int fail(int code, const std::string& message) {
  fmt::print(stderr, "error: {}\n", message);
  return code;
}

}  // namespace

const Option& Option::type_name(const std::string& name) const { return option_->type_name(name), *this; }
const Option& Option::group(const std::string& heading) const { return option_->group(heading), *this; }
const Option& Option::required() const { return option_->required(), *this; }
const Option& Option::one_word() const { return option_->allow_extra_args(false), *this; }
const Option& Option::delimiter(char character) const { return option_->delimiter(character), *this; }
const Option& Option::excludes(const std::string& other) const { return option_->excludes(other), *this; }

Command Command::add_command(const std::string& name, const std::string& description) const {
  return Command(app_->add_subcommand(name, description));
}
Option Command::add_option(const std::string& names, std::string& value, const std::string& description) const {
  return Option(app_->add_option(names, value, description));
}
Option Command::add_option(const std::string& names, Text& value, const std::string& description) const {
  return Option(app_->add_option(names, value, description));
}
Option Command::add_option(const std::string& names, std::vector<std::string>& values,
                           const std::string& description) const {
  return Option(app_->add_option(names, values, description));
}
Option Command::add_flag(const std::string& names, bool& value, const std::string& description) const {
  return Option(app_->add_flag(names, value, description));
}
void Command::set_version(const std::string& text) const { app_->set_version_flag("--version", text); }
void Command::footer(const std::string& text) const { app_->footer(text); }
void Command::callback(std::function<void()> function) const { app_->callback(std::move(function)); }
void Command::pass_words_on(std::function<void(std::vector<std::string>)> function) const {
  app_->set_help_flag();
  app_->prefix_command();
  app_->callback([app = app_, function = std::move(function)] { function(app->remaining()); });
}

Program::Program(const std::string& name, const std::string& description)
    : Command(nullptr), owned_(std::make_unique<CLI::App>(description, name)) {
  app_ = owned_.get();
}
Program::~Program() = default;

void Program::require_command() {
  needs_command_ = true;
  app_->require_subcommand(1);
}

int Program::run(int argc, char** argv) {
  constexpr int wrong_command = static_cast<int>(ErrorKind::command);
  constexpr int wrong_machine = static_cast<int>(ErrorKind::machine);
  if (needs_command_ && argc < 2) {
    fmt::print(stderr, "{}", app_->help());
    return wrong_command;
  }
  try {
    std::vector<std::string> words = checked_words(*app_, {argv + 1, argv + argc});
    std::reverse(words.begin(), words.end());  // as CLI11 wants them
    app_->parse(words);
    return 0;
  } catch (const CLI::Success& success) {  // --help, --version
    return app_->exit(success);
  } catch (const CLI::ParseError& error) {
    return fail(wrong_command, error.what());
  } catch (const ExitCode& exit) {
    return exit.code;
  } catch (const Error& error) {
    return fail(error.exit_code(), error.what());
  } catch (const std::bad_alloc&) {
    return fail(wrong_machine, "not enough memory; a smaller --size or scene needs less");
  } catch (const std::exception& error) {
    return fail(wrong_machine, error.what());
  }
}

}  // namespace omma::tool

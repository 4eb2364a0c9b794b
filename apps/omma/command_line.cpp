#include "command_line.h"

#include <algorithm>

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

}  // namespace

std::vector<std::string> checked_arguments(const CLI::App& tool, const std::vector<std::string>& words) {
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

}  // namespace omma::tool

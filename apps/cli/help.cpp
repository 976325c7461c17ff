#include "help.h"

#include <fmt/format.h>

#include <filesystem>
#include <vector>

namespace tetsoup::cli {

namespace {

const CLI::App& chosen_command(const CLI::App& app) {
  const auto chosen = app.get_subcommands();
  return chosen.empty() ? app : *chosen.front();
}

std::string short_name(const CLI::Option& option) {
  return option.get_snames().empty() ? option.get_name() : "-" + option.get_snames().front();
}

std::string describe_unknown(const CLI::App& app, const std::string& word) {
  const bool is_flag = word.starts_with('-');
  if (&chosen_command(app) != &app)
    return word + (is_flag ? ": there is no such option here" : ": not expected; one input at a time");
  if (is_flag) return word + ": options stand behind the command, as in tetsoup mesh IN -o OUT";
  std::error_code ignored;
  if (std::filesystem::exists(word, ignored))
    return fmt::format("{0}: name a command first, as in tetsoup mesh {0} -o out.msh", word);
  return word + ": there is no such command; there are mesh, inspect, field, sample, simulate and studio";
}

/// The library lists what it did not expect from back to front, values of unknown options among it.
std::string first_unknown(const CLI::App& app) {
  const std::vector<std::string> words = app.remaining(true);
  for (const std::string& word : words)
    if (word.starts_with('-')) return word;
  return words.empty() ? std::string() : words.front();
}

std::string describe_wrong_count(const CLI::App& command, const CLI::ParseError& error) {
  for (const CLI::Option* const option : command.get_options())
    if (option->count() > 1 && option->get_expected_max() == 1)
      return fmt::format("{}: given {} times; give it once", short_name(*option), option->count());
  const std::string text = error.what();
  return text.substr(0, text.find(':')) + ": its value is missing";
}

std::string describe_missing(const CLI::App& command, const CLI::ParseError& error) {
  for (const CLI::Option* const option : command.get_options())
    if (option->get_required() && option->count() == 0)
      return option->get_positional() ? option->get_name() + ": the input file is missing"
                                      : short_name(*option) + ": the output file is missing";
  return error.what();
}

}  // namespace

std::string HelpLayout::make_usage(const CLI::App* app, std::string name) const {
  std::string text = "\nUsage: " + name;
  if (!app->get_subcommands([](const CLI::App*) { return true; }).empty()) text += " COMMAND";
  for (const CLI::Option* const option : app->get_options()) {
    const std::string words =
        option->get_positional() ? option->get_name() : short_name(*option) + " " + option->get_option_text();
    if (option->get_required())
      text += " " + words;
    else if (option->get_positional())
      text += " [" + words + "]";
  }
  return text + " [OPTIONS]\n\n";
}

std::string HelpLayout::make_group(std::string group, bool is_positional,
                                   std::vector<const CLI::Option*> options) const {
  // The base class puts a blank line before every group and another one behind all but the positionals and the last.
  const std::string text = CLI::Formatter::make_group(std::move(group), is_positional, std::move(options)).substr(1);
  return is_positional ? text + "\n" : text;
}

std::string describe_usage_error(const CLI::App& app, const CLI::ParseError& error) {
  const CLI::App& command = chosen_command(app);
  std::string text = error.what();
  if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr) text = describe_unknown(app, first_unknown(app));
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) != nullptr) text = describe_wrong_count(command, error);
  if (dynamic_cast<const CLI::RequiredError*>(&error) != nullptr) text = describe_missing(command, error);
  if (dynamic_cast<const CLI::ExcludesError*>(&error) != nullptr) text += "; give only one of them";
  return text + help_hint(app);
}

std::string help_hint(const CLI::App& app) {
  const CLI::App& command = chosen_command(app);
  return &command == &app ? "; see `tetsoup --help`" : fmt::format("; see `tetsoup {} --help`", command.get_name());
}

}  // namespace tetsoup::cli

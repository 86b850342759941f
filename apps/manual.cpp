// sofof manual: the page for `man sofof`, made of what the commands say.
#include "apps/command.hpp"
#include "apps/command_list.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <iostream>
#include <string>
#include <string_view>

namespace sofof::apps {

namespace {

/// @returns text as troff takes it: no sign of it is a request.
std::string roff(std::string_view text) {
  std::string made;
  for (const auto c : text) {
    if ((c == '.' || c == '\'') && (made.empty() || made.back() == '\n'))
      made += "\\&";
    if (c == '\\')
      made += "\\e";
    else if (c == '-')
      made += "\\-";
    else
      made += c;
  }
  return made;
}

/// "[--seed N] FILE"
std::string usage_of(const listed_command& command) {
  auto text = fmt::format("\\fBsofof {}\\fR", roff(command.name));
  if (!command.options.empty())
    text += " [\\fIOPTION\\fR...]";
  for (const auto& one : command.arguments) {
    const auto name = fmt::format("\\fI{}\\fR{}", roff(one.names.front()),
                                  one.several ? "..." : "");
    text += one.required || one.kind == argument_kind::command
                ? ' ' + name
                : fmt::format(" [{}]", name);
  }
  return text;
}

std::string paragraph_of(const listed_argument& one) {
  std::string names;
  for (const auto& name : one.names)
    names += fmt::format("{}\\fB{}\\fR", names.empty() ? "" : ", ", roff(name));
  if (!one.value.empty())
    names += fmt::format(" \\fI{}\\fR", roff(one.value));
  auto about = one.about;
  if (about.empty())
    about = fmt::format("One of: {}.", fmt::join(one.words, ", "));
  return fmt::format(".TP\n{}\n{}\n", names, roff(about));
}

std::string section_of(const listed_command& command) {
  auto text =
      fmt::format(".SS {}\n{}.\n", usage_of(command), roff(command.about));
  for (const auto& one : command.arguments)
    text += paragraph_of(one);
  for (const auto& one : command.options)
    if (one.names.front() != "--help") // every command has it
      text += paragraph_of(one);
  const auto is_nested = command.name.find(' ') != std::string::npos;
  if (!command.footer.empty() && !is_nested)
    text += fmt::format(".PP\n.nf\n{}\n.fi\n", roff(command.footer));
  return text;
}

std::string manual_page(const CLI::App& app) {
  auto text = fmt::format(
      ".TH SOFOF 1 \"\" \"sofof {}\" \"User Commands\"\n.SH NAME\n"
      "sofof \\- {}\n.SH SYNOPSIS\n.B sofof\n.I COMMAND\n.RI [ OPTION ...]\n"
      ".SH DESCRIPTION\n"
      "Runs services of connected automated vehicles in the vehicles or at "
      "edge "
      "servers, by policies, in virtual time or on the wall clock.\n"
      ".SH COMMANDS\n",
      SOFOF_VERSION, "function offloading for connected automated vehicles");
  for (const auto& command : list_commands(app))
    text += section_of(command);
  return text
         + ".SH FILES\n.TP\n.I config/NAME.toml\nScenarios that are called by "
           "their names; where there is none, those of the folder "
           "share/sofof beside the program's.\n"
           ".SH EXIT STATUS\n.TP\n0\ndone\n.TP\n1\nthe run was unsafe or "
           "failed, or a message is wrong\n.TP\n2\nwrong input or usage\n"
           ".TP\n130\ninterrupted\n"
           ".SH EXAMPLES\n.nf\nsofof run ulm_lehr\nsofof report "
           "results/ulm_lehr\\-1\nsofof help run\n.fi\n";
}

} // namespace

void add_manual(CLI::App& app, int&) {
  auto* command =
      app.add_subcommand("manual", "Print the page for man, as troff has it");
  command->footer("Example:\n  sofof manual >sofof.1; man ./sofof.1");
  command->callback([&app] { std::cout << manual_page(app); });
}

} // namespace sofof::apps

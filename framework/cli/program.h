#pragma once

#include <iosfwd>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace plaza {

/// The whole program but for the process around it: parses, runs the command, prints errors as
/// lines that begin with "plaza: ", and returns the exit status.
int run_program(const std::vector<std::string>& arguments, std::ostream& errors);

/// Names of all commands, in the order of the help text.
std::vector<std::string> command_names(const CLI::App& app);

}  // namespace plaza

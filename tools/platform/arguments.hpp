// The words of the command line.
#pragma once

#include <string>
#include <vector>

namespace espalier::tools {

/// Returns the words behind the program's name, in UTF-8; `count` and `values` are those of main.
std::vector<std::string> words_of_command_line(int count, char** values);

}  // namespace espalier::tools

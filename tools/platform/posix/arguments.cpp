#include "platform/arguments.hpp"

#include <algorithm>

namespace espalier::tools {

std::vector<std::string> words_of_command_line(int count, char** values) {
    return {values + std::min(count, 1), values + count};
}

}  // namespace espalier::tools

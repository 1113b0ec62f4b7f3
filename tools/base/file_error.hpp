// The error about a file that cannot be read.
#pragma once

#include <string>

namespace espalier::tools {

/// Throws CommandError (file_access) with the reason, a value of errno.
[[noreturn]] void fail_to_read(const std::string& path, int error);

}  // namespace espalier::tools

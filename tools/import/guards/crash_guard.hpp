// The importer parses files of strangers in a library that is not ours: when it crashes, the user learns which file did
// it, and scripts see the exit status of invalid input.
#pragma once

#include <string>

#include "import/base/imported.hpp"
#include "platform/process.hpp"

namespace espalier::tools {

/// While it lives, a crash of this process (a bad access, a failed assertion, a stack used up) ends it with
/// ExitCode::invalid_input and a message that names `path`. Nothing has been written by then. One at a time.
class CrashGuard {
public:
    CrashGuard(const std::string& path, const ImportOptions& options);

private:
    Guard signals_;
};

}  // namespace espalier::tools

// Errors of Windows as values of errno.
#pragma once

namespace espalier::tools {

/// Returns the error of the last call of this thread that failed; EIO for those that errno has no value of.
int last_error();

}  // namespace espalier::tools

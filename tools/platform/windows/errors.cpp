#include "errors.hpp"

#include <windows.h>

#include <cerrno>
#include <system_error>

namespace espalier::tools {

int last_error() {
    const std::error_code error(static_cast<int>(::GetLastError()), std::system_category());
    const std::error_condition condition = error.default_error_condition();
    return condition.category() == std::generic_category() ? condition.value() : EIO;
}

}  // namespace espalier::tools

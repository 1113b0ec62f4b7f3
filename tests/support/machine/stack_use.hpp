// How many bytes of stack a call needs, measured: call on a painted stack, see how far the paint is gone.
#pragma once

#include <cstddef>

#include <espalier/base/function_ref.hpp>

namespace espalier::tests {

/// Includes the frame of the callable itself. Without meaning under the sanitizers, which give frames other sizes.
std::size_t stack_use(FunctionRef<void()> call);

}  // namespace espalier::tests

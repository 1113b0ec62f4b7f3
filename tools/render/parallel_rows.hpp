// The rows of a picture over the cores of the machine.
#pragma once

#include <functional>

namespace espalier::tools {

/// Calls `row` once for each number below `rows`, from several threads, in no order; `done`, from this thread only,
/// with the share that is begun. `threads` 0 takes as many as the machine has.
void for_each_row(unsigned rows, unsigned threads, const std::function<void(unsigned)>& row,
                  const std::function<void(double)>& done);

}  // namespace espalier::tools

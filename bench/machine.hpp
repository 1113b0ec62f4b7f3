// What a speed is measured on, for the rows that hold it.
#pragma once

#include <string>

namespace espalier::bench {

/// The name that the kernel gives; Linux only, elsewhere empty.
std::string processor();

/// Of this program.
const char* compiler();

/// Returns the date, in UTC.
std::string today();

}  // namespace espalier::bench

// What a blob that opened must stand, whoever made its bytes.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include <espalier/blob.hpp>

#include "support/base/random.hpp"

namespace espalier::fuzz {

/// Ends the program: a promise is broken.
[[noreturn]] void fail(const char* what, const std::string& detail);

/// The same with the line of the call, unless the promise holds.
inline void require(bool holds, const char* promise, const char* file = __builtin_FILE(), int line = __builtin_LINE()) {
    if (!holds) fail(promise, file + (':' + std::to_string(line)));
}

enum class Maker { anyone, baker };

/// Every query with arguments that are drawn: safe, within its steps, the same on every instruction set; the
/// independent decoder reads the blob too, and if it is sound, every query is answered as the loop over its triangles
/// does. What a baker made must be.
void judge(std::span<const std::byte> bytes, const Blob& blob, tests::Random& random, Maker maker = Maker::anyone);

}  // namespace espalier::fuzz

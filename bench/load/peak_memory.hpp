// The memory that something takes at most.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>

namespace espalier::bench {

/// Returns how many bytes of memory a process gets from the system at most while it runs `work`, beyond those that it
/// has before; pages of files that `work` maps are among them. A child process runs `work` twice and counts the second
/// time: by then the program's own pages are there. `work` must free what it takes. Nothing where it is less than half
/// a megabyte, which Linux does not count exactly, where the system counts nothing, or where the child fails.
///
/// Call it before a library starts threads, which a child does not have.
[[nodiscard]] std::optional<std::size_t> peak_memory(const std::function<void()>& work);

}  // namespace espalier::bench

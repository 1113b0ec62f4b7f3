// This process: the words of its command line, its standard streams, and what it holds for a while: handlers of
// crashes and interrupts, limits on memory and processor time.
// Errors are values of errno.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace espalier::importer {

/// Returns the words behind the program's name, in UTF-8; `count` and `values` are those of main.
std::vector<std::string> words_of_command_line(int count, char** values);

/// Makes the streams carry bytes as they are, and a console show UTF-8. Call it before they are used.
void prepare_standard_streams();

/// Tests whether stderr is a terminal that obeys escape sequences.
bool is_stderr_terminal();

/// Tests whether the path names what the standard output is: /dev/stdout, or the file that it is redirected to.
/// /dev/null is not: it takes any number of outputs.
bool is_standard_output(const std::string& path);

/// Writes both texts and ends the process at once. Safe in a handler of signals.
[[noreturn]] void end_process(int exit_code, std::string_view to_stderr, std::string_view to_stdout);

/// Holds something for the process, up to the end of its last copy. One of a kind at a time.
using Guard = std::shared_ptr<const void>;

/// Returns what makes an interrupt of the process wait, so that it leaves no temporary file behind.
[[nodiscard]] Guard hold_interrupts();

/// Returns what calls `handler` with the number of the signal on a bad access, a failed assertion or a stack used up,
/// on memory that is left then; what was there before comes back after it.
[[nodiscard]] Guard handle_crashes(void (*handler)(int), std::size_t stack_bytes);

/// Stores what lets the process add so much memory and no more: an allocation beyond it fails. 0 is no limit. Returns 0
/// or an error.
int limit_memory(std::uint64_t added_bytes, Guard& guard);

/// Stores what calls `handler` after so much processor time of the process, user and system: anywhere, so that it may
/// neither allocate nor lock. 0 is no limit. Returns 0 or an error.
int limit_processor_time(double seconds, void (*handler)(), Guard& guard);

/// Tests whether systems of this kind can limit the memory of a process.
bool can_limit_memory();

/// Returns the bytes of memory that the machine has.
std::uint64_t machine_memory();

}  // namespace espalier::importer

#include "last_words.hpp"

#include "base/numbers.hpp"
#include "platform/standard_streams.hpp"

namespace espalier::tools {

LastWords last_words(const CommandError& error, const ImportOptions& options) {
    return {static_cast<int>(error.code()), text("espalier: ", error.what(), '\n'),
            options.failure_document ? options.failure_document(error) : std::string()};
}

void end_with(const LastWords& words) { end_process(words.exit_code, words.to_stderr, words.to_stdout); }

}  // namespace espalier::tools

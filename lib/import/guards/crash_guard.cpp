#include <import/guards/limit_guard.hpp>

namespace espalier::importer {

namespace {

LastWords crash_words;

void end_with_crash_words(int) { end_with(crash_words); }

auto crash_handler_that_names(const std::string& path, const ImportOptions& options) {
    crash_words = options.last_words(crash_error(path).reason());
    return end_with_crash_words;
}

}  // namespace

CrashGuard::CrashGuard(const std::string& path, const ImportOptions& options)
    : signals_(options.last_words ? handle_crashes(crash_handler_that_names(path, options), std::size_t{1} << 16)
                                  : nullptr) {}

}  // namespace espalier::importer

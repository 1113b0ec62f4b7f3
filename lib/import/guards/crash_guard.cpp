#include <import/guards/limit_guard.hpp>

#include <import/base/error.hpp>

namespace espalier::importer {

namespace {

LastWords crash_words;

void end_with_crash_words(int) { end_with(crash_words); }

auto crash_handler_that_names(const std::string& path, const ImportOptions& options) {
    crash_words = last_words({ImportStatus::invalid_input,
                              text("the importer crashed while it read '", printable(path),
                                   "': a mistake of the importer, which the file may have caused by being broken. "
                                   "Export it again, or in another format, such as glTF."),
                              {.file = path, .kind = "importer_crash"}},
                             options);
    return end_with_crash_words;
}

}  // namespace

CrashGuard::CrashGuard(const std::string& path, const ImportOptions& options)
    : signals_(handle_crashes(crash_handler_that_names(path, options), std::size_t{1} << 16)) {}

}  // namespace espalier::importer

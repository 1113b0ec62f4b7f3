// Files read in a child process, which sends what it finds through a pipe: messages, of which the last is the result.
#include <import/files.hpp>

#include <cstdint>
#include <cstdio>
#include <cstring>
#include <mutex>
#include <new>
#include <utility>

#include <import/base/error.hpp>
#include <import/base/library_state.hpp>
#include <import/guards/limit_guard.hpp>
#include <import/platform/child.hpp>
#include <import/transfer/fields.hpp>

namespace espalier::importer {

namespace {

enum class Message : std::uint8_t { file, progress, log, warning, result };

/// How a child ends that has no result to send.
constexpr int crashed = 101, out_of_time = 102, out_of_memory = 103;

int read_in_child(std::span<const std::string> paths, ImportOptions options, std::FILE* to_parent) {
    FieldWriter fields(to_parent);
    const auto send = [&fields](Message message, const auto&... values) {
        fields(message, values...);
        fields.flush();
    };
    options.last_words = [](const ImportDiagnostic& reason) {
        return LastWords{reason.kind == "import_seconds" ? out_of_time : crashed, {}, {}};
    };
    if (options.progress)
        options.progress = [&send](const char* stage, double done) {
            send(Message::progress, std::string(stage), done);
        };
    if (options.log) options.log = [&send](const std::string& line) { send(Message::log, line); };
    if (options.warn) options.warn = [&send](const ImportDiagnostic& warning) { send(Message::warning, warning); };
    ImportResult result;
    try {
        import_or_refuse(result, [&] {
            import_files(paths, options, result, [&send](const std::string& path) { send(Message::file, path); });
        });
    } catch (const std::bad_alloc&) {
        return out_of_memory;
    }
    send(Message::result, result);
    return 0;
}

/// Reads messages up to the result. `path` becomes the file that was begun last.
void receive(FieldReader& fields, const ImportOptions& options, ImportResult& imported, std::string& path) {
    while (true) {
        Message message = Message::result;
        fields(message);
        std::string text;
        double done = 0.0;
        ImportDiagnostic warning;
        switch (message) {
            case Message::file:
                fields(path);
                break;
            case Message::progress:
                fields(text, done);
                options.progress(text.c_str(), done);
                break;
            case Message::log:
                fields(text);
                options.log(text);
                break;
            case Message::warning:
                fields(warning);
                options.warn(warning);
                break;
            case Message::result:
                fields(imported);
                return;
        }
    }
}

[[noreturn]] void refuse_end(const ChildEnd& end, const std::string& path, const ImportLimits& limits) {
    if (end.exit_status == crashed) throw crash_error(path);
    if (end.exit_status == out_of_time) throw time_error(path, limits);
    if (end.exit_status == out_of_memory) throw std::bad_alloc();
    throw ImportError(
        ImportStatus::internal,
        text("the process that read '", printable(path), "' ended ",
             end.signal != 0 ? text("by signal ", end.signal) : text("with status ", end.exit_status),
             ". It was ended from outside, as when a machine runs out of memory, or by a mistake: please report that."),
        {.file = path});
}

}  // namespace

void import_in_child(std::span<const std::string> paths, const ImportOptions& options, ImportResult& imported) {
    std::unique_lock lock(library_state());
    ChildProcess child([&](std::FILE* to_parent) {
        lock.unlock();  // that of the child
        return read_in_child(paths, options, to_parent);
    });
    lock.unlock();
    if (child.error() != 0) {
        throw_error(ImportStatus::unsupported,
                    "files cannot be read in a process of their own: ", std::strerror(child.error()),
                    ". Read them in this one, if you trust them.");
    }
    FieldReader fields([&child](std::span<std::byte> bytes) { return child.read(bytes); });
    std::string path;
    try {
        receive(fields, options, imported, path);
    } catch (const EndOfFields&) {
        const ChildEnd end = child.wait();
        imported = {};
        refuse_end(end, path, options.limits);
    }
    static_cast<void>(child.wait());
    if (imported) return;
    const ImportDiagnostic reason = imported.reason;
    throw ImportError(imported.status, reason.message, {reason.file, reason.mesh, reason.triangle, reason.kind});
}

}  // namespace espalier::importer

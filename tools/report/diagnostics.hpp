// Messages, warnings and errors. People read them on stderr, so that stdout stays data; scripts get one document on
// stdout.
#pragma once

#include <chrono>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "base/exit_code.hpp"
#include "json.hpp"

namespace espalier::tools {

class Console {
public:
    explicit Console(bool quiet = false) : quiet_(quiet) {}
    /// Prints a line of these parts, unless quiet.
    template <class... Parts>
    void say(const Parts&... parts) const {
        if (!quiet_) print(text(parts...));
    }
    /// Prints a line, also if quiet.
    static void warn(const Warning& warning);

private:
    static void print(const std::string& line);

    bool quiet_;
};

/// One line that overwrites itself: on a terminal only, and only once the work has lasted a second.
class Progress {
public:
    explicit Progress(bool quiet);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;
    void show(const char* stage, double done);
    /// Clears the line, which the next call of show writes again.
    void hide();

private:
    using Clock = std::chrono::steady_clock;
    bool enabled_;
    bool shown_ = false;
    Clock::time_point next_;
};

/// Sends what was printed to stdout on its way. Throws CommandError (file_access) when it could not be written, as on a
/// full disk: data that is silently cut short is worse than none.
void finish_standard_output();

/// To stdout, and checks that it got there.
void print_json(const Json& document);

/// Prints warnings and adds them to the list.
void give(std::span<const Warning> found, std::vector<Warning>& warnings);

/// Returns an object with kind, message, file, mesh and triangle; what is unknown is null. Errors have the same keys.
Json diagnostic_json(const Warning& warning);
Json warnings_json(std::span<const Warning> warnings);

/// Prints the error's message to stderr, and `document` with the key `error` to stdout, if there is one. Returns the
/// exit status.
ExitCode report_failure(const CommandError& error, Json* document);

/// Returns the text of the document of a verb that failed before it had a result, with the warnings until then.
std::string failure_document(const CommandError& error, const std::vector<Warning>& warnings);

/// Returns the exception that is being handled as an error of the command.
CommandError current_failure();

/// Runs a verb, which adds its warnings to the list as it finds them. An error that ends it carries them.
ExitCode with_warnings(const std::function<ExitCode(std::vector<Warning>&)>& verb);

}  // namespace espalier::tools

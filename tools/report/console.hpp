// Messages of the command to people: on stderr, so that stdout stays data.
#pragma once

#include <chrono>
#include <string>

#include "base/exit_code.hpp"

namespace espalier::tools {

class Console {
public:
    explicit Console(bool quiet = false) : quiet_(quiet) {}
    /// Prints a line, unless quiet.
    void say(const std::string& line) const;
    /// Prints a line, also if quiet.
    static void warn(const Warning& warning);

private:
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

}  // namespace espalier::tools

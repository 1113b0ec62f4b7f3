#include "console.hpp"

#include <algorithm>
#include <cstdio>
#include <iostream>

#include "base/exit_code.hpp"
#include "base/numbers.hpp"
#include "platform/standard_streams.hpp"

namespace espalier::tools {

void Console::say(const std::string& line) const {
    if (!quiet_) std::cerr << line << '\n';
}

void Console::warn(const Warning& warning) { std::cerr << "warning: " << warning.message << '\n'; }

Progress::Progress(bool quiet)
    : enabled_(!quiet && is_stderr_terminal()), next_(Clock::now() + std::chrono::seconds(1)) {}

Progress::~Progress() { hide(); }

void Progress::hide() {
    if (shown_) std::cerr << "\r\x1b[K" << std::flush;
    shown_ = false;
}

void Progress::show(const char* stage, double done) {
    if (!enabled_) return;
    const auto now = Clock::now();
    if (now < next_) return;
    next_ = now + std::chrono::milliseconds(100);
    shown_ = true;
    const int percent = static_cast<int>(100.0 * std::clamp(done, 0.0, 1.0));
    std::cerr << "\r\x1b[K" << percent << " % " << stage << std::flush;
}

void finish_standard_output() {
    std::cout.flush();
    if (!std::cout || std::fflush(stdout) != 0) {
        throw CommandError(ExitCode::file_access,
                           "standard output cannot be written; is the disk full, or the reader gone?");
    }
}

}  // namespace espalier::tools

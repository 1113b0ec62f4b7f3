#include <import/platform/child.hpp>

#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>

#ifdef __linux__
#include <sys/prctl.h>
#endif

namespace espalier::importer {

namespace {

/// A program that another thread starts meanwhile must not keep the pipe open.
int make_pipe(int (&ends)[2]) {
#ifdef __linux__
    return ::pipe2(ends, O_CLOEXEC);
#else
    if (::pipe(ends) != 0) return -1;
    for (const int end : ends) ::fcntl(end, F_SETFD, FD_CLOEXEC);
    return 0;
#endif
}

/// Handlers of the program around belong to its own work, a crash is no core dump of that program, and a child outlives
/// it for nothing.
void leave_the_program() {
    for (int signal = 1; signal < NSIG; ++signal)
        if (signal != SIGKILL && signal != SIGSTOP) ::signal(signal, SIG_DFL);
    sigset_t none;
    sigemptyset(&none);
    ::pthread_sigmask(SIG_SETMASK, &none, nullptr);
    const struct rlimit no_core {};
    ::setrlimit(RLIMIT_CORE, &no_core);
#ifdef __linux__
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
#endif
}

/// An exception must not lead the child on into the program.
int status_of(const std::function<int(std::FILE* to_parent)>& work, std::FILE* to_parent) {
    constexpr int failed = 1;
    if (to_parent == nullptr) return failed;
    try {
        const int status = work(to_parent);
        return std::fflush(to_parent) == 0 ? status : failed;
    } catch (...) {
        return failed;
    }
}

}  // namespace

ChildProcess::ChildProcess(const std::function<int(std::FILE* to_parent)>& work) {
    int ends[2];
    if (make_pipe(ends) != 0) {
        error_ = errno;
        return;
    }
    id_ = ::fork();
    if (id_ == 0) {
        leave_the_program();
        ::close(ends[0]);
        ::_exit(status_of(work, ::fdopen(ends[1], "wb")));
    }
    if (id_ < 0) error_ = errno;
    ::close(ends[1]);
    from_child_ = error_ == 0 ? ::fdopen(ends[0], "rb") : nullptr;
    if (from_child_ != nullptr) return;
    if (error_ == 0) error_ = errno;
    ::close(ends[0]);
}

ChildProcess::~ChildProcess() {
    if (from_child_ != nullptr) std::fclose(from_child_);
    if (id_ <= 0) return;
    ::kill(static_cast<pid_t>(id_), SIGKILL);
    wait();
}

std::size_t ChildProcess::read(std::span<std::byte> bytes) {
    std::size_t count = 0;
    while (count < bytes.size()) {
        errno = 0;
        count += std::fread(bytes.data() + count, 1, bytes.size() - count, from_child_);
        if (errno != EINTR) break;
        std::clearerr(from_child_);  // a signal of the program around
    }
    return count;
}

ChildEnd ChildProcess::wait() {
    int status = 0;
    pid_t ended = -1;
    do ended = ::waitpid(static_cast<pid_t>(id_), &status, 0);
    while (ended < 0 && errno == EINTR);
    id_ = -1;
    if (ended < 0) return {};
    return WIFSIGNALED(status) ? ChildEnd{0, WTERMSIG(status)} : ChildEnd{WEXITSTATUS(status), 0};
}

}  // namespace espalier::importer

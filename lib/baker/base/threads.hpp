// Threads, where the machine has them. Where it has none (WebAssembly), the one there is does everything.
#pragma once

#include <algorithm>
#include <exception>
#include <utility>

#if defined(__STDCPP_THREADS__)
#include <thread>
#endif

namespace espalier::baker {

#if defined(__STDCPP_THREADS__)

using ThreadId = std::thread::id;

inline ThreadId this_thread() { return std::this_thread::get_id(); }

inline unsigned machine_threads() { return std::max(1u, std::thread::hardware_concurrency()); }

/// Works beside its maker, who waits for it on every way out. What the work throws, `wait` throws: out of a thread it
/// would end the program.
class Helper {
public:
    Helper() = default;
    Helper(const Helper&) = delete;
    Helper& operator=(const Helper&) = delete;
    ~Helper() {
        if (thread_.joinable()) thread_.join();
    }

    /// False when the machine gives no more threads: nothing was done.
    template <class Work>
    [[nodiscard]] bool start(Work work) {
        try {
            thread_ = std::thread([this, work = std::move(work)]() mutable {
                try {
                    work();
                } catch (...) {
                    thrown_ = std::current_exception();
                }
            });
        } catch (const std::exception&) {
            return false;
        }
        return true;
    }

    void wait() {
        if (thread_.joinable()) thread_.join();
        if (thrown_) std::rethrow_exception(std::exchange(thrown_, nullptr));
    }

private:
    std::exception_ptr thrown_;
    std::thread thread_;
};

#else

using ThreadId = int;

inline ThreadId this_thread() { return 0; }

inline unsigned machine_threads() { return 1; }

class Helper {
public:
    template <class Work>
    [[nodiscard]] bool start(const Work&) {
        return false;
    }
    void wait() {}
};

#endif

}  // namespace espalier::baker

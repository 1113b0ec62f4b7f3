// Running the parts of a batch, without Python's lock, on one thread or several.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

#include <pybind11/pybind11.h>

namespace espalier::python {

/// Queries that a thread takes at a time: few enough that their results stay in a processor's cache.
inline constexpr std::size_t part_size = 1024;

/// Returns the number of threads to start: that which the caller gave, or for 0 that of the machine's processors.
inline unsigned threads_for(unsigned given, std::size_t parts) {
    const unsigned wanted = given != 0 ? given : std::max(1u, std::thread::hardware_concurrency());
    return static_cast<unsigned>(std::min<std::size_t>({wanted, std::max<std::size_t>(parts, 1), 1024}));
}

/// Returns nothing to hold: what a batch reads never changes.
struct WithoutLock {
    int operator()() const { return 0; }
};

/// Calls work(part) for the parts 0 .. parts - 1 on some threads. Rethrows the first exception. Releases Python's lock,
/// and holds what lock() returns only meanwhile: a thread that made Python objects with it could wait for itself, since
/// their allocation runs finalizers.
template <class Work, class Lock = WithoutLock>
void run_parts(std::size_t parts, unsigned threads, const Work& work, const Lock& lock = {}) {
    const pybind11::gil_scoped_release unlocked;
    [[maybe_unused]] const auto held = lock();
    threads = threads_for(threads, parts);
    if (threads == 1) {
        for (std::size_t part = 0; part < parts; ++part) work(part);
        return;
    }
    std::atomic<std::size_t> next{0};
    std::exception_ptr failure;
    std::mutex failures;
    const auto take = [&] {
        try {
            for (std::size_t part = next++; part < parts; part = next++) work(part);
        } catch (...) {
            const std::lock_guard first(failures);
            if (!failure) failure = std::current_exception();
            next = parts;
        }
    };
    {
        std::vector<std::jthread> helpers;
        try {
            for (unsigned i = 1; i < threads; ++i) helpers.emplace_back(take);
        } catch (const std::system_error&) {  // the machine starts no more: those that run do the work
        }
        take();
    }
    if (failure) std::rethrow_exception(failure);
}

/// Calls work(begin, end) for ranges of part_size queries that cover 0 .. count - 1.
template <class Work, class Lock = WithoutLock>
void run_ranges(std::size_t count, unsigned threads, const Work& work, const Lock& lock = {}) {
    run_parts((count + part_size - 1) / part_size, threads,
              [&](std::size_t part) { work(part * part_size, std::min(count, (part + 1) * part_size)); }, lock);
}

/// Writes answer(i) to results[i] for each query.
template <class Result, class Answer, class Lock = WithoutLock>
void answer_each(Result* results, std::size_t count, unsigned threads, const Answer& answer, const Lock& lock = {}) {
    run_ranges(
        count, threads,
        [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) results[i] = answer(i);
        },
        lock);
}

}  // namespace espalier::python

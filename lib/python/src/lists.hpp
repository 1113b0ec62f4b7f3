// Lists of results: offsets and one array.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <new>
#include <span>
#include <vector>

#include <pybind11/numpy.h>

#include <espalier/status.hpp>

#include "floats.hpp"
#include "parts.hpp"

namespace espalier::python {

/// An array that grows without setting its places. Its elements are plain values.
template <class Value>
class Growing {
public:
    /// Returns free places: at least `wanted`.
    std::span<Value> places(std::size_t wanted) {
        if (capacity_ - count_ < wanted) {
            if (wanted > PTRDIFF_MAX / sizeof(Value) / 4) throw std::bad_alloc();
            const std::size_t capacity = std::max(count_ + wanted, capacity_ + capacity_ / 2 + 64);
            void* memory = std::realloc(memory_.get(), capacity * sizeof(Value));
            if (memory == nullptr) throw std::bad_alloc();
            static_cast<void>(memory_.release());
            memory_.reset(static_cast<Value*>(memory));
            capacity_ = capacity;
        }
        return {memory_.get() + count_, capacity_ - count_};
    }
    void add(std::size_t written) { count_ += written; }
    /// Removes the elements from one on.
    void cut(std::size_t first) { count_ = first; }
    void push(const Value& value) {
        places(1)[0] = value;
        ++count_;
    }
    /// Returns the elements from one on.
    std::span<Value> from(std::size_t first) { return {memory_.get() + first, count_ - first}; }
    [[nodiscard]] std::size_t count() const { return count_; }
    [[nodiscard]] const Value* data() const { return memory_.get(); }

    /// Moves the elements to an array of NumPy.
    py::array to_numpy(const py::dtype& type) {
        if (count_ == 0) return py::array(type, std::vector<py::ssize_t>{0});
        const auto size = static_cast<py::ssize_t>(count_);
        const py::capsule owner(memory_.get(), [](void* memory) { std::free(memory); });
        Value* memory = memory_.release();
        count_ = capacity_ = 0;
        return py::array(type, std::vector<py::ssize_t>{size}, memory, owner);
    }

private:
    struct Free {
        void operator()(Value* memory) const { std::free(memory); }
    };
    std::unique_ptr<Value, Free> memory_;
    std::size_t count_ = 0;
    std::size_t capacity_ = 0;
};

/// Appends what walk(visit) visits and returns its status. No exception passes through the library.
template <class Value, class Walk>
QueryStatus append(Growing<Value>& all, const Walk& walk) {
    bool is_short = false;
    const QueryStatus status = walk([&](const Value& value) {
        try {
            all.push(value);
        } catch (const std::bad_alloc&) {
            is_short = true;
            return Visit::stop;
        }
        return Visit::next;
    });
    if (is_short) throw std::bad_alloc();
    return status;
}

/// Returns (offsets, elements, statuses) of a batch, where list(query, elements) appends those of a query and returns
/// its status. Holds what lock() returns while it calls list().
template <class Value, class List, class Lock = WithoutLock>
py::tuple make_lists(const Batch& batch, const py::dtype& type, unsigned threads, const List& list,
                     const Lock& lock = {}) {
    const std::size_t count = batch.count();
    py::array_t<py::ssize_t> offsets(static_cast<py::ssize_t>(count + 1));
    py::ssize_t* const ends = offsets.mutable_data();
    py::array statuses = batch.results(py::dtype::of<std::uint8_t>());
    auto* const status = static_cast<QueryStatus*>(statuses.mutable_data());
    const std::size_t size = threads == 1 ? std::max<std::size_t>(count, 1) : part_size;
    std::vector<Growing<Value>> parts((count + size - 1) / size);
    ends[0] = 0;
    run_parts(
        parts.size(), threads,
        [&](std::size_t part) {
            for (std::size_t i = part * size; i < std::min(count, (part + 1) * size); ++i) {
                const std::size_t before = parts[part].count();
                status[i] = list(i, parts[part]);
                ends[i + 1] = static_cast<py::ssize_t>(parts[part].count() - before);
            }
        },
        lock);
    for (std::size_t i = 0; i < count; ++i) ends[i + 1] += ends[i];
    if (parts.size() == 1) return py::make_tuple(offsets, parts[0].to_numpy(type), statuses);
    Growing<Value> all;
    all.places(static_cast<std::size_t>(ends[count]));
    for (const Growing<Value>& part : parts) {
        if (part.count() == 0) continue;
        std::memcpy(static_cast<void*>(all.places(part.count()).data()), part.data(), part.count() * sizeof(Value));
        all.add(part.count());
    }
    return py::make_tuple(offsets, all.to_numpy(type), statuses);
}

}  // namespace espalier::python

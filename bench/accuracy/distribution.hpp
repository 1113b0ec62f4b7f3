// What many errors come to: the median, the 99 % quantile and the largest.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <vector>

namespace espalier::bench {

class Distribution {
public:
    void add(double value) { values_.push_back(value); }

    /// ,"name":[median, 99 %, largest]; null where there is nothing
    void print(const char* name) {
        if (values_.empty()) {
            std::printf(",\"%s\":null", name);
            return;
        }
        std::sort(values_.begin(), values_.end());
        std::printf(",\"%s\":[%.6g,%.6g,%.6g]", name, quantile(0.5), quantile(0.99), values_.back());
    }

private:
    [[nodiscard]] double quantile(double share) const {
        return values_[static_cast<std::size_t>(share * static_cast<double>(values_.size() - 1))];
    }

    std::vector<double> values_;
};

}  // namespace espalier::bench

// What many errors come to: the median, the 99 % quantile and the largest.
#pragma once

#include "../../tests/oracle/double_tree.hpp"
#include "../base.hpp"

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

// Closest hits on the blob, judged by the same rays on the source in double precision.

/// What the source answers, found once and held against every lattice.
[[nodiscard]] std::vector<reference::ReferenceHit> reference_hits(const reference::DoubleTree& source,
                                                                  const std::vector<Ray>& rays);

/// Prints fields of a JSON object, each after a comma: rays missed and extra, t, normals, and how far the points that
/// are answered lie from the source's surface (for the first `points` hits).
void print_ray_accuracy(const Blob& blob, const reference::DoubleTree& source, const std::vector<Ray>& rays,
                        const std::vector<reference::ReferenceHit>& references, std::size_t points);

// The queries that may err by as much as you allow: how often and how far they do, and what work that saves.

/// Prints a JSON object a line for each query and accuracy, each beginning with `head`, which is an object's first
/// fields.
void print_approximate_accuracy(const char* head, const Blob& blob, const tests::Mesh& mesh,
                                const reference::DoubleTree& source, std::size_t questions);

}  // namespace espalier::bench

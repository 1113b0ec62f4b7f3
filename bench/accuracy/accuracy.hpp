// What many errors come to: the median, the 99 % quantile and the largest.
#pragma once

#include "../../tests/oracle/double_tree.hpp"
#include "../base.hpp"

namespace espalier::bench {

class Distribution {
public:
    void add(double value) { values_.push_back(value); }

    /// Adds [median, 99 %, largest], or null where there is nothing.
    void add_to(JsonObject& row, const std::string& name) {
        std::sort(values_.begin(), values_.end());
        row.add_raw(name, values_.empty() ? "null" : json_list({quantile(0.5), quantile(0.99), quantile(1.0)}));
    }

private:
    [[nodiscard]] std::string quantile(double share) const {
        return digits_of(values_[static_cast<std::size_t>(share * static_cast<double>(values_.size() - 1))], 6);
    }

    std::vector<double> values_;
};

// Closest hits on the blob, judged by the same rays on the source in double precision.

/// What the source answers, found once and held against every lattice.
[[nodiscard]] std::vector<reference::ReferenceHit> reference_hits(const reference::DoubleTree& source,
                                                                  const std::vector<Ray>& rays);

/// Adds fields to a row: rays missed and extra, t, normals, and how far the points that are answered lie from the
/// source's surface (for the first `points` hits).
void add_ray_accuracy(JsonObject& row, const Blob& blob, const reference::DoubleTree& source,
                      const std::vector<Ray>& rays, const std::vector<reference::ReferenceHit>& references,
                      std::size_t points);

// The queries that may err by as much as you allow: how often and how far they do, and what work that saves.

/// Prints a row for each query and accuracy, each beginning with the fields of `head`.
void print_approximate_accuracy(const JsonObject& head, const Blob& blob, const tests::Mesh& mesh,
                                const reference::DoubleTree& source, std::size_t questions);

}  // namespace espalier::bench

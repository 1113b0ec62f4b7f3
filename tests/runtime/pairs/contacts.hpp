// Lists of contacts of two blobs, for tests.
#pragma once

#include "support/testing.hpp"

namespace espalier::tests {

inline constexpr WorkLimit unlimited = WorkLimit::unlimited();

using Contacts = std::vector<PairContact>;

inline Contacts all_contacts(const PlacedBlob& a, const PlacedBlob& b) {
    Contacts all;
    REQUIRE(for_each_contact(
                a, b, [&](const PairContact& pair) { all.push_back(pair); }, unlimited) == QueryStatus::ok);
    return all;
}

}  // namespace espalier::tests

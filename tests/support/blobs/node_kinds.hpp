// Which kind of node a profile has, for tests of the runtime's kernels.
#pragma once

#include <runtime/blob/node.hpp>

#include "support/base/profiles.hpp"

namespace espalier::tests {

/// Calls with the kind of node that a profile has.
template <class Call>
void with_node_kind(Profile profile, Call call) {
    if (format::has_plain_nodes(profile)) call.template operator()<detail::PlainNode>();
    else call.template operator()<detail::PackedNode>();
}

/// Calls with the kind of node and each profile that has it.
template <class Call>
void for_each_node_kind(Call call) {
    for_each_profile([&](Profile profile) {
        with_node_kind(profile, [&]<class Node>() { call.template operator()<Node>(profile); });
    });
}

}  // namespace espalier::tests

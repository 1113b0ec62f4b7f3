// Calls sorted into groups of like work, and what a call of each group costs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace espalier::bench {

/// The numbers of some calls, ascending, so that incoherent ones stay incoherent.
using Members = std::vector<std::uint32_t>;

/// Equal shares of all calls by one count, and each of these in equal shares by another one. Both have an entry for
/// each call.
std::vector<Members> group_by_work(std::span<const std::uint64_t> first, std::span<const std::uint64_t> second);

/// Runs all groups in turn, again and again, and returns the nanoseconds of a call of each, in processor time.
///
/// `calls` has the number of calls of each group, and `run` makes them; what it returns keeps compilers from dropping
/// them. A group's time is the median over the rounds of its ratio to the round's median, times the median of these: a
/// machine that is busy elsewhere for a while slows whole rounds down. With `is_warm` each group runs twice in a turn
/// and the second run is timed, for groups that share what they work on with some of the others.
std::vector<double> time_in_turns(std::span<const std::size_t> calls, unsigned rounds, bool is_warm,
                                  const std::function<unsigned(std::size_t group)>& run);

}  // namespace espalier::bench

// Claims about the section of original ids as the baker writes it: a reader of its own follows the format's rules, and
// the kinds are compared with others that the same numbers could have.
#include "support/testing.hpp"

#include <random>

#include <baker/encode/ids.hpp>

#include "support/base/answer_hash.hpp"

namespace espalier::tests::id_kinds_test {
namespace {

namespace ids = format::ids;
using Numbers = std::vector<std::uint32_t>;

std::uint32_t mask_of(unsigned number_bits) {
    return static_cast<std::uint32_t>((std::uint64_t{1} << number_bits) - 1);
}

struct Row {
    std::uint32_t offset = 0, width = 0, prefix = 0, from = 0, replaced = 0;
    friend bool operator==(const Row&, const Row&) = default;

    [[nodiscard]] bool reaches(std::uint32_t number, const std::vector<std::uint32_t>& recent,
                               std::uint32_t mask) const {
        return std::uint64_t{(number - recent[from] - offset) & mask} < std::uint64_t{1} << width;
    }
    void follow(std::uint32_t number, std::vector<std::uint32_t>& recent) const {
        recent.erase(recent.begin() + replaced);
        recent.insert(recent.begin(), number);
    }
};

/// A section as bytes, and what they lead to.
struct Section {
    std::vector<std::byte> bytes;
    std::vector<Row> rows;
    unsigned kind_bits = 0;
    Numbers read;
    std::size_t step_bits = 0;  ///< of all steps: what first numbers and whole bytes take is left out

    [[nodiscard]] std::size_t bits() const { return step_bits + 8 * ids::kind_bytes * rows.size(); }
};

std::uint32_t word(const std::vector<std::byte>& bytes, std::size_t at, std::size_t count = 4) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < count; ++i) value |= std::to_integer<std::uint32_t>(bytes.at(at + i)) << (8 * i);
    return value;
}

Section written(const Numbers& numbers, unsigned number_bits) {
    Section section;
    const baker::IdSteps steps = baker::put_ids(section.bytes, numbers, number_bits);
    section.kind_bits = steps.kind_bits;
    REQUIRE(steps.kind_bits <= ids::max_kind_bits);
    for (std::size_t row = 0; row < std::size_t{1} << steps.kind_bits; ++row) {
        const std::size_t at = row * ids::kind_bytes;
        section.rows.push_back({word(section.bytes, at + ids::offset_at), word(section.bytes, at + ids::width_at, 1),
                                word(section.bytes, at + ids::prefix_at, 1), word(section.bytes, at + ids::from_at, 1),
                                word(section.bytes, at + ids::replaced_at, 1)});
    }
    const std::size_t begin = section.rows.size() * ids::kind_bytes;
    const std::size_t blocks = (numbers.size() + ids::block_triangles - 1) / ids::block_triangles;
    const std::size_t block_table = begin + (steps.bytes + 3) / 4 * 4;
    REQUIRE(section.bytes.size() == block_table + ids::block_bytes(true) * blocks);

    std::size_t bit = 0;
    const auto take = [&](unsigned width) {
        std::uint32_t value = 0;
        for (unsigned i = 0; i < width; ++i, ++bit)
            value |= (word(section.bytes, begin + bit / 8, 1) >> bit % 8 & 1u) << i;
        return value;
    };
    const std::uint32_t mask = mask_of(number_bits);
    for (std::size_t block = 0; block < blocks; ++block) {
        bit = (bit + 7) / 8 * 8;
        const std::size_t entry = block_table + ids::block_bytes(true) * block, block_begin = bit / 8;
        REQUIRE(word(section.bytes, entry) == block_begin);
        std::uint32_t run_begins = word(section.bytes, entry + 4);
        const std::uint32_t first = take(number_bits);
        section.read.push_back(first);
        std::vector<std::uint32_t> recent(ids::recent_numbers, first);
        const std::size_t end = std::min<std::size_t>(numbers.size(), (block + 1) * ids::block_triangles);
        while (section.read.size() < end) {
            if (section.read.size() % ids::run_triangles(true) == 0) {
                bit = (bit + 7) / 8 * 8;
                REQUIRE((run_begins & 1023) == bit / 8 - block_begin);
                run_begins >>= 10;
                recent.assign(ids::recent_numbers, first);
            }
            const std::size_t at = bit;
            const Row& row = section.rows[take(steps.kind_bits)];
            bit = at + row.prefix;
            section.read.push_back((recent[row.from] + row.offset + take(row.width)) & mask);
            row.follow(section.read.back(), recent);
            section.step_bits += bit - at;
        }
        REQUIRE(run_begins == 0);
    }
    REQUIRE((bit + 7) / 8 == steps.bytes);
    return section;
}

/// Whether a block begins with a number, to which no step leads. All recent numbers are a block's first at the
/// beginning of each run.
bool begin_run(const Numbers& numbers, std::size_t at, std::vector<std::uint32_t>& recent) {
    const std::size_t in_block = at % ids::block_triangles;
    if (at % ids::run_triangles(true) == 0) recent.assign(ids::recent_numbers, numbers[at - in_block]);
    return in_block == 0;
}

/// How many bits the same numbers take with two kinds: this one, and the one for every step.
std::size_t bits_with(const Row& row, const Numbers& numbers, unsigned number_bits) {
    const Row any = {0, number_bits, 1, 0, ids::recent_numbers - 1};
    std::size_t bits = 2 * 8 * ids::kind_bytes;
    std::vector<std::uint32_t> recent;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        if (begin_run(numbers, i, recent)) continue;
        const Row& taken = row.reaches(numbers[i], recent, mask_of(number_bits)) ? row : any;
        bits += 1 + taken.width;
        taken.follow(numbers[i], recent);
    }
    return bits;
}

std::size_t steps_of(std::size_t count) { return count - (count + ids::block_triangles - 1) / ids::block_triangles; }

/// Numbers of `rows` rows, in each round all of them in another order; a row goes on `step` after its last number. The
/// rows are far from each other.
Numbers rows_by_turns(unsigned rows, std::uint32_t step, std::size_t count, unsigned number_bits) {
    Random random(rows);
    std::vector<std::uint32_t> lasts;
    for (std::uint32_t row = 0; row < rows; ++row) lasts.push_back(row * row * 7919);
    Numbers numbers;
    while (numbers.size() < count) {
        const std::size_t in_round = numbers.size() % rows;
        const std::size_t chosen = in_round + random.below(static_cast<std::uint32_t>(rows - in_round));
        std::swap(lasts[in_round], lasts[chosen]);
        numbers.push_back(lasts[in_round] & mask_of(number_bits));
        lasts[in_round] += step;
    }
    return numbers;
}

/// Each `low` to `high` after the one before, by chance.
Numbers steps_within(std::int32_t low, std::int32_t high, std::size_t count, unsigned number_bits) {
    Random random(count);
    Numbers numbers;
    std::uint32_t number = 12345;
    for (std::size_t i = 0; i < count; ++i) {
        numbers.push_back(number & mask_of(number_bits));
        number += static_cast<std::uint32_t>(random.between(low, high));
    }
    return numbers;
}

Numbers by_chance(std::size_t count, unsigned number_bits) {
    Random random(count);
    Numbers numbers;
    for (std::size_t i = 0; i < count; ++i)
        numbers.push_back(static_cast<std::uint32_t>(random.next() >> 32) & mask_of(number_bits));
    return numbers;
}

/// As leaves of a grid: pieces of rows of eight cells, and pieces of the rows above them.
Numbers patches(std::uint32_t side, unsigned number_bits) {
    Numbers numbers;
    for (std::uint32_t y = 0; y < side; y += 8)
        for (std::uint32_t x = 0; x < side; x += 8)
            for (std::uint32_t i = 0; i < 128; ++i)
                numbers.push_back((((y + i / 16) * side + x) * 2 + i % 16) & mask_of(number_bits));
    return numbers;
}

std::vector<Numbers> all_orders(unsigned number_bits) {
    std::vector<Numbers> orders;
    for (const std::size_t count : {1u, 2u, 127u, 128u, 129u, 1000u}) {
        orders.push_back(by_chance(count, number_bits));
        orders.push_back(rows_by_turns(1, 1, count, number_bits));
        orders.push_back(rows_by_turns(5, 2, count, number_bits));
        orders.push_back(steps_within(-5, 9, count, number_bits));
    }
    orders.push_back(patches(64, number_bits));
    orders.push_back(patches(256, number_bits));  // more than are looked at
    return orders;
}

/// The same numbers with every compiler.
class Draws {
public:
    explicit Draws(std::uint32_t seed) : engine_(seed) {}
    std::uint32_t operator()() { return static_cast<std::uint32_t>(engine_()); }

private:
    std::mt19937 engine_;
};

/// Some rows that go on by some steps, and jumps; the counts of all are drawn too.
Numbers drawn(std::uint32_t seed, unsigned number_bits) {
    Draws random(seed);
    const std::size_t count = 2 + random() % 400;
    const std::size_t rows = 1 + random() % 8;
    std::uint32_t steps[8];
    for (std::uint32_t& step : steps) step = random();
    const std::size_t kinds = 1 + random() % 8;
    const std::uint32_t jumps = 2 + random() % 30;
    std::uint32_t at[8] = {};
    Numbers numbers;
    while (numbers.size() < count) {
        const std::size_t row = random() % rows;
        at[row] += steps[random() % kinds];
        if (random() % jumps == 0) at[row] = random();
        numbers.push_back(at[row] & mask_of(number_bits));
    }
    return numbers;
}

/// Eight rows that go on by eight steps, each as likely as the others.
Numbers sixty_four_kinds(std::size_t count) {
    Draws random(0);
    std::uint32_t at[8], steps[8];
    for (std::uint32_t& number : at) number = random();
    for (std::uint32_t& step : steps) step = random();
    Numbers numbers;
    while (numbers.size() < count) {
        const std::size_t row = random() % 8;
        numbers.push_back(at[row] += steps[random() % 8]);
    }
    return numbers;
}

TEST_CASE("ids: sections lead to their numbers by steps of the kinds that take fewest bits") {
    for (const unsigned number_bits : {1u, 2u, 7u, 17u, 32u}) {
        CAPTURE(number_bits);
        for (const Numbers& numbers : all_orders(number_bits)) {
            CAPTURE(numbers.size());
            const Section section = written(numbers, number_bits);
            REQUIRE(section.read == numbers);
            // Each row is of one kind with all rows that end like it, and some kind takes every step.
            bool takes_all = false;
            for (std::size_t i = 0; i < section.rows.size(); ++i) {
                const Row& row = section.rows[i];
                REQUIRE(row.prefix <= section.kind_bits);
                REQUIRE(row.width <= number_bits);
                REQUIRE(row.offset <= mask_of(number_bits));
                takes_all = takes_all || row.width == number_bits;
                for (std::size_t j = i % (std::size_t{1} << row.prefix); j < section.rows.size();
                     j += std::size_t{1} << row.prefix)
                    REQUIRE(section.rows[j] == row);
            }
            REQUIRE(takes_all);
            // The fewest bits for each step, by the kinds that there are.
            std::size_t fewest = 0;
            std::vector<std::uint32_t> recent;
            for (std::size_t i = 0; i < numbers.size(); ++i) {
                if (begin_run(numbers, i, recent)) continue;
                const Row* best = nullptr;
                for (const Row& row : section.rows)
                    if (row.reaches(numbers[i], recent, mask_of(number_bits)) &&
                        (best == nullptr || row.prefix + row.width < best->prefix + best->width))
                        best = &row;
                REQUIRE(best != nullptr);
                fewest += best->prefix + best->width;
                best->follow(numbers[i], recent);
            }
            CHECK(section.step_bits <= fewest + numbers.size());
        }
    }
}

TEST_CASE("ids: a second kind is written just where it saves more than it takes") {
    for (const unsigned number_bits : {3u, 9u, 20u, 32u}) {
        for (std::size_t count = 1; count < 70; ++count) {
            CAPTURE(number_bits);
            CAPTURE(count);
            const Section section = written(rows_by_turns(1, 5, count, number_bits), number_bits);
            const std::size_t kind = 8 * ids::kind_bytes, steps = steps_of(count);
            const std::size_t wide = (count - 1) / ids::run_triangles(true) * number_bits;  // first steps of other runs
            CHECK(section.bits() == std::min(kind + steps * number_bits, 2 * kind + steps + wide));
        }
    }
}

TEST_CASE("ids: rows that are gone on with in any order take less than two thirds of the bits of whole numbers") {
    const std::size_t count = 10 * ids::block_triangles;
    for (unsigned rows = 1; rows <= ids::recent_numbers; ++rows) {
        for (const std::uint32_t step : {1u, 0u - 1u}) {
            CAPTURE(rows);
            CAPTURE(step);
            CHECK(3 * written(rows_by_turns(rows, step, count, 20), 20).bits() < 2 * 20 * steps_of(count));
        }
    }
}

TEST_CASE("ids: steps of one range take hardly more bits than with a kind made for it") {
    for (unsigned width = 1; width < 12; ++width) {
        const auto reach = std::int32_t{1} << width;
        for (const std::int32_t low : {1, -reach, -reach / 2}) {
            CAPTURE(width);
            CAPTURE(low);
            const Numbers numbers = steps_within(low, low + reach - 1, 5000, 16);
            const Row row = {static_cast<std::uint32_t>(low) & mask_of(16), width, 1, 0, 0};
            CHECK(written(numbers, 16).bits() <= bits_with(row, numbers, 16));
        }
    }
}

TEST_CASE("ids: sections have the same bytes on every machine") {
    struct Expected {
        unsigned number_bits;
        std::uint64_t hash;
    };
    for (const Expected& expected :
         {Expected{1, 18235912596784385503u}, Expected{2, 13781216443353399934u}, Expected{7, 15575131383888016152u},
          Expected{17, 4896487780802621819u}, Expected{32, 7641078052692720528u}}) {
        CAPTURE(expected.number_bits);
        AnswerHash hash;
        for (const Numbers& numbers : all_orders(expected.number_bits))
            for (const std::byte byte : written(numbers, expected.number_bits).bytes)
                hash.add(std::to_integer<std::uint32_t>(byte));
        CHECK(hash.value() == expected.hash);
    }
}

TEST_CASE("ids: the most rows of kinds are used where they save bits") {
    CHECK(written(sixty_four_kinds(6000), 32).kind_bits == ids::max_kind_bits);
}

TEST_CASE("ids: sections of few numbers have the same bytes on every machine") {
    AnswerHash hash;
    for (const unsigned number_bits : {2u, 6u, 8u}) {
        for (std::uint32_t seed = 0; seed < 4000; seed += 100)
            for (const std::byte byte : written(drawn(seed + number_bits, number_bits), number_bits).bytes)
                hash.add(std::to_integer<std::uint32_t>(byte));
    }
    CHECK(hash.value() == 14597298679217404045u);
}

}  // namespace
}  // namespace espalier::tests::id_kinds_test

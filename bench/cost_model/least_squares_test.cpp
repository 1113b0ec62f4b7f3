// Claims about fits: they find the costs that made the values, and predict values that they were not given.
#include <doctest/doctest.h>

#include "model.hpp"

using namespace espalier::bench;

namespace {

/// Returns values of 20 for each of one count, 3 for each of another and 7 for each, which are off by up to a share.
std::vector<Observation> observations(double share_off) {
    espalier::tests::Random random(5);
    std::vector<Observation> all;
    for (int i = 0; i < 60; ++i) {
        const double first = 1.0 + 10.0 * static_cast<double>(random.unit());
        const double second = 50.0 * static_cast<double>(random.unit());
        const double off = share_off * static_cast<double>(random.signed_unit());
        all.push_back({{first, second, 1.0}, (20.0 * first + 3.0 * second + 7.0) * (1.0 + off)});
    }
    return all;
}

}  // namespace

TEST_CASE("bench: a fit finds the costs that values are made of") {
    for (const Differences differences : {Differences::absolute, Differences::relative}) {
        const auto fitted = fit(observations(0.0), differences);
        REQUIRE(fitted);
        CHECK(fitted->coefficients[0] == doctest::Approx(20.0));
        CHECK(fitted->coefficients[1] == doctest::Approx(3.0));
        CHECK(fitted->coefficients[2] == doctest::Approx(7.0));
        CHECK(fitted->explained == doctest::Approx(1.0));
    }
}

TEST_CASE("bench: a fit to half of the values predicts the other half") {
    const auto exact = predict_held_out(observations(0.0), Differences::relative);
    REQUIRE(exact);
    CHECK(exact->worst_error < 1e-9);
    const std::vector<Observation> noisy = observations(0.2);
    const auto predicted = predict_held_out(noisy, Differences::relative);
    REQUIRE(predicted);
    double worst = 0.0;
    for (std::size_t i = 0; i < noisy.size(); ++i)
        worst = std::max(worst, std::abs(predicted->values[i] / noisy[i].value - 1.0));
    CHECK(predicted->worst_error == worst);
    CHECK(predicted->median_error < worst);
    CHECK(predicted->median_error > 0.02);
    CHECK(worst > 0.1);
    CHECK(worst < 0.4);
}

TEST_CASE("bench: no value has a part in its own prediction") {
    std::vector<Observation> changed = observations(0.2);
    const auto before = predict_held_out(changed, Differences::absolute);
    changed[10].value *= 5.0;
    const auto after = predict_held_out(changed, Differences::absolute);
    REQUIRE(before);
    REQUIRE(after);
    CHECK(after->values[10] == before->values[10]);
    CHECK(after->values[12] == before->values[12]);
    CHECK(after->values[11] != before->values[11]);
}

TEST_CASE("bench: counts that grow together determine no costs") {
    std::vector<Observation> all;
    for (int i = 1; i < 20; ++i) all.push_back({{1.0 * i, 2.0 * i, 1.0}, 5.0 * i});
    CHECK_FALSE(fit(all, Differences::absolute));
    CHECK_FALSE(predict_held_out(all, Differences::absolute));
}

#include <catch2/catch.hpp>

#include "core/input/suggest.hpp"
#include "core/input/units.hpp"

using namespace proveta::input;

TEST_CASE("texts with units become SI numbers") {
    CHECK(parse_quantity("28 GPa", Unit::pressure).value == 28e9);
    CHECK(parse_quantity("150mm", Unit::length).value == Approx(0.15).epsilon(1e-15));
    CHECK(parse_quantity(" 0.02 m/s ", Unit::velocity).value == 0.02);
    CHECK(parse_quantity("0.6 mm/min", Unit::velocity).value == Approx(1e-5).epsilon(1e-14));
    CHECK(parse_quantity("25 %", Unit::none).value == 0.25);
    CHECK(parse_quantity("1e-3", Unit::length).value == 1e-3);
    CHECK(parse_quantity("+3 MPa", Unit::pressure).value == 3e6);
    CHECK(parse_quantity("100 J/m2", Unit::energy_per_area).problem.empty());
}

TEST_CASE("wrong quantities are problems, never numbers") {
    for (const char* text : {"", "NaN", "inf", "mm", "3 kg", "3 MPa x", "1e999 m", "-inf m", "--3 m"}) {
        INFO(text);
        CHECK_FALSE(parse_quantity(text, Unit::length).problem.empty());
    }
}

TEST_CASE("what may be meant by a unit is said") {
    CHECK(parse_quantity("30,5 MPa", Unit::pressure).problem.find("decimals have a point: \"30.5 MPa\"") != std::string::npos);
    CHECK(parse_quantity("30 mpa", Unit::pressure).problem.find("did you mean \"30 MPa\"?") != std::string::npos);
    CHECK(parse_quantity("30 N/mm²", Unit::pressure).value == Approx(30e6));
    CHECK(parse_quantity("30 N/mm^2", Unit::pressure).value == Approx(30e6));
    CHECK(parse_quantity("5 µm", Unit::length).value == Approx(5e-6));
    CHECK(parse_quantity("4000 psi", Unit::pressure).value == Approx(27.579e6).epsilon(1e-4));
}

TEST_CASE("quantities are shown in handy units and read back") {
    CHECK(format_quantity(28e9, Unit::pressure) == "28 GPa");
    CHECK(format_quantity(0.15, Unit::length) == "15 cm");
    CHECK(format_quantity(5e-7, Unit::time) == "500 ns");
    CHECK(format_quantity(0.0, Unit::pressure) == "0 Pa");
    for (const double x : {3.2e6, 4.5e-4, 17.0, 123456.0}) {
        CHECK(parse_quantity(format_quantity(x, Unit::pressure), Unit::pressure).value == Approx(x).epsilon(1e-5));
    }
}

TEST_CASE("misspelt words find their neighbour, strange ones none") {
    const std::vector<std::string> keys{"confining_pressure", "rate", "stop", "platen_friction"};
    CHECK(nearest("confinning_pressure", keys) == "confining_pressure");
    CHECK(nearest("raet", keys) == "rate");
    CHECK(nearest("Stop", keys) == "stop");
    CHECK(nearest("temperature", keys).empty());
    CHECK(nearest(std::string(5000, 'a'), keys).empty());
}

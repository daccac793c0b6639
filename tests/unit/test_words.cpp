// Small work on text that readers of files have in common.
#include <catch2/catch.hpp>

#include "core/input/words.hpp"

using namespace proveta;

TEST_CASE("lines end in any of the three ways, the last one with or without an end") {
    using Lines = std::vector<std::string_view>;
    CHECK(input::lines_of("a\nb\r\nc\rd") == Lines{"a", "b", "c", "d"});
    CHECK(input::lines_of("a\n\r\n\r") == Lines{"a", "", ""});
    CHECK(input::lines_of("").empty());
    std::size_t at = 2;
    CHECK(input::take_line("a\nb\r\nc", at) == "b");
    CHECK(at == 5);
}

TEST_CASE("words, blanks, letters, and the first five of many") {
    CHECK(input::words_of(" a\t bc \r\n") == std::vector<std::string_view>{"a", "bc"});
    CHECK(input::trimmed(" \ta b\r\n") == "a b");
    CHECK(input::trimmed("__a_", "_") == "a");
    CHECK(input::trimmed(" \n").empty());
    CHECK(input::lower_case("MPa \xC3\x84") == "mpa \xC3\x84"); // letters beyond ASCII stay
    CHECK(input::first_few({"1", "2"}) == "1, 2");
    CHECK(input::first_few({"1", "2", "3", "4", "5"}, "; ") == "1; 2; 3; 4; 5");
    CHECK(input::first_few({"1", "2", "3", "4", "5", "6"}) == "1, 2, 3, 4, 5, ...");
    CHECK(input::shown("a\nb\"") == "\"a?b\"\"");
    CHECK(input::shown(std::string(41, 'a')) == '"' + std::string(40, 'a') + "...\"");
}

// Tables of numbers in text files of others.
#include <catch2/catch.hpp>

#include <cmath>

#include "core/input/column_heading.hpp"
#include "core/input/text_table.hpp"
#include "tests/support.hpp"

using namespace proveta;
using namespace proveta::testing;
using input::TextTable;
using input::Unit;

namespace {

std::string refusal(const std::function<void()>& action) {
    try {
        action();
    } catch (const std::runtime_error& e) {
        return e.what();
    }
    return "";
}

bool holds(const std::string& text, const std::string& part) {
    INFO("\"" << text << "\" lacks \"" << part << "\"");
    CHECK(text.find(part) != std::string::npos);
    return text.find(part) != std::string::npos;
}

} // namespace

TEST_CASE("text table: separators and decimals are found out") {
    const TemporaryFolder folder;
    const char* const ways[] = {"a,b\n0.001,2.5\n0.002,-3e1\n",
                                "a;b\n0,001;2,5\n0,002;-3e1\n",
                                "a\tb\n0,001\t2,5\n0,002\t-3e1\n",
                                "a b\n0.001 2.5\n0.002   -3e1\n",
                                "a b\n0,001 2,5\n0,002 -3e1\n",
                                "\357\273\277a,b\r\n0.001,2.5\r\n0.002,-3e1\r\n",
                                "\"a\",\"b\"\n\"0.001\",\"2.5\"\n\"0.002\",\"-3e1\"\n",
                                "a;b\n0.001; +2.5\n0.002;-30\n",
                                "a,b\n\"0,001\",\"2,5\"\n\"0,002\",\"-30\"\n",
                                "# text\n\na,b\n0.001,2.5\n# more\n0.002,-30\n",
                                "a,b,\n0.001,2.5,\n0.002,-30,\n",
                                "a,b\r0.001,2.5\r0.002,-30\r",
                                "  a  b\n  0.001  2.5\n  0.002  -30\n"};
    for (const char* text : ways) {
        INFO(text);
        const TextTable table(folder.file("t.csv", text));
        REQUIRE(table.rows() == 2);
        CHECK(table.has_headings());
        CHECK(table.numbers(table.find("a")) == std::vector<double>{0.001, 0.002});
        CHECK(table.numbers(table.find("b")) == std::vector<double>{2.5, -30.0});
    }
    std::string wide = "\xFF\xFE"; // UTF-16, as a spreadsheet writes "Unicode text"
    for (const char c : std::string("a\tb\n1\t2\n")) {
        wide += c;
        wide += '\0';
    }
    CHECK(TextTable(folder.file("w.txt", wide)).numbers(1) == std::vector<double>{2.0});
    CHECK(holds(refusal([&] { TextTable(folder.file("w.txt", wide.substr(0, wide.size() - 1))); }), "UTF-16"));
}

TEST_CASE("text table: matter before the headings, a row of units, units in headings") {
    const TemporaryFolder folder;
    const TextTable t(
        folder.file("t.csv", "Specimen;A12\nDate;2020-01-01\nDiameter (mm);50\n\nstrain;Stress [MPa];Kraft / kN\n0;0;1\n0,001;28;2\n"));
    REQUIRE(t.rows() == 2);
    CHECK(t.line(0) == 6);
    CHECK(t.columns()[1].name == "Stress");
    CHECK(t.columns()[1].unit == "MPa");
    CHECK(t.columns()[2].unit == "kN");
    CHECK(t.find("Stress") == 1);
    CHECK(t.find("Stress [MPa]") == 1);
    CHECK(t.find("3") == 2);
    const TextTable u(folder.file("u.csv", "strain,stress\n-,MPa\n0,0\n0.001,28\n"));
    CHECK(u.rows() == 2);
    CHECK(u.columns()[0].unit == "-");
    CHECK(u.columns()[1].unit == "MPa");
    const TextTable blanks(folder.file("b.txt", "x [mm] y [mm] r [mm]\n1 2 3\n4 5 6\n"));
    CHECK(blanks.columns()[2].name == "r");
    CHECK(blanks.columns()[2].unit == "mm");
    const TextTable none(folder.file("n.txt", "0 1\n2 3\n"));
    CHECK_FALSE(none.has_headings());
    CHECK(none.numbers(none.find("2")) == std::vector<double>{1.0, 3.0});
    for (const auto& [heading, name, unit] : {std::tuple{"eps_a_microstrain", "eps_a", "microstrain"},
                                              {"Axial strain (%)", "Axial strain", "%"},
                                              {"stress, MPa", "stress", "MPa"},
                                              {"x_mm", "x", "mm"},
                                              {"axial_stress_Pa", "axial_stress", "Pa"},
                                              {"sigma_max", "sigma_max", ""},
                                              {"strain 1", "strain 1", ""}}) {
        INFO(heading);
        const auto c = input::column_of_heading(heading);
        CHECK(c.name == name);
        CHECK(c.unit == unit);
    }
}

TEST_CASE("text table: missing cells, text in other columns, cells that are no numbers") {
    const TemporaryFolder folder;
    const TextTable t(folder.file("t.csv", "time,a,b\n2021-03-04 12:00:00,1,#N/A\n2021-03-04 12:00:01,2,\n2021-03-04 12:00:02,NaN,5\n"));
    CHECK_FALSE(t.is_number(0));
    const auto b = t.numbers(2);
    CHECK(std::isnan(b[0]));
    CHECK(std::isnan(b[1]));
    CHECK(b[2] == 5.0);
    CHECK(std::isnan(t.numbers(1)[2]));
    CHECK(holds(refusal([&] { (void)t.numbers(0); }), "line 2: \"2021-03-04 12:00:00\" is no number, in column \"time\""));
    const TextTable w(folder.file("w.csv", "a,b\nx,1\n2,3\n4,5\n"));
    CHECK(w.rows() == 3);
    CHECK(holds(refusal([&] { (void)w.numbers(0); }), "line 2: \"x\" is no number"));
}

TEST_CASE("text table: headings behind a comment's mark, and text that is no UTF-8") {
    const TemporaryFolder folder;
    const TextTable t(folder.file("n.csv", "# made by hand\n# strain,stress [MPa]\n1,2\n3,4\n"));
    CHECK(t.find("stress") == 1);
    CHECK(t.columns()[1].unit == "MPa");
    const TextTable none(folder.file("c.csv", "# two words, and more, here\n1,2\n3,4\n"));
    CHECK_FALSE(none.has_headings());
    const TextTable latin(folder.file("l.csv", "strain (\xb5m/m);stress (N/mm\xb2)\n1;2\n3;4\n"));
    CHECK(latin.columns()[0].unit == "µm/m");
    CHECK(latin.columns()[1].unit == "N/mm²");
    const TextTable utf(folder.file("u.csv", "strain (µm/m);stress (N/mm²)\n1;2\n3;4\n"));
    CHECK(utf.columns()[1].unit == "N/mm²");
}

TEST_CASE("text table: lines with the same fault are told together") {
    const TemporaryFolder folder;
    const TextTable t(folder.file("t.csv", "a,b\n1,2\nx,3\n4,5\ny,6\n7,8\n9,1\n"));
    const auto cells = refusal([&] { (void)t.numbers(0); });
    CHECK(holds(cells, "line 3: \"x\" is no number, in column \"a\"; line 5: \"y\""));
    const auto rows = refusal([&] { TextTable(folder.file("r.csv", "a,b\n1,2\n3\n4,5\n6,7\n8,9,1\n")); });
    CHECK(holds(rows, "line 3: 1 cells where the other rows have 2; line 6: 3 cells"));
    std::string many = "a,b\n1,2\n1,2\n";
    for (int k = 0; k < 20; ++k) {
        many += "x,1\n1,2\n1,2\n";
    }
    const auto some = refusal([&] { (void)TextTable(folder.file("m.csv", many)).numbers(0); });
    CHECK(holds(some, "; ..."));
    CHECK(some.size() < 300);
}

TEST_CASE("text table: what cannot be told is refused") {
    const TemporaryFolder folder;
    CHECK(holds(refusal([&] { TextTable(folder.file("t.csv", std::string("\x1f\x8b\x08\x00\x01", 5))); }), "compressed by gzip"));
    CHECK(holds(refusal([&] { TextTable(folder.file("t.csv", "PK\x03\x04xlsx")); }), "save the table as CSV"));
    CHECK(holds(refusal([&] { TextTable(folder.file("t.csv", "a,b\n1.0D-02,x\n")); }), "\"1.0D-02\" is no number"));
    const auto why = [&](const char* text) { return refusal([&] { TextTable(folder.file("t.csv", text)); }); };
    CHECK(holds(why("a,b\n1,2\n3,4\n5,6,7\n"), "line 4: 3 cells where the other rows have 2"));
    CHECK(holds(why("a,b\n1,2\n3,4\nend of test\n"), "line 4: 1 cells"));
    CHECK(holds(why("\n"), "no rows of numbers"));
    CHECK(holds(why("a,b\n"), "no rows of numbers"));
    CHECK(holds(why("a,b\n1,2\n3,\"4\n"), "line 3: a quotation mark that never closes"));
    const TextTable t(folder.file("e.csv", "a,b,b\n1,2,3\n4,5,6\n"));
    CHECK(t.find("a") == 0);
    CHECK(holds(refusal([&] { (void)t.find("b"); }), "\"b\" is the heading of columns 2 and 3"));
    CHECK(holds(refusal([&] { (void)t.find("bb"); }), "no column \"bb\"; there are \"a\", \"b\", \"b\""));
    // Decimal commas where commas separate: four cells under two headings.
    const TextTable d(folder.file("d.csv", "a,b\n0,5,1,5\n0,6,2,5\n"));
    CHECK(holds(refusal([&] { (void)d.find("a"); }), "it has 2 cells where the rows have 4"));
}

TEST_CASE("text table: columns are matched by name and unit") {
    const TemporaryFolder folder;
    const TextTable t(folder.file("t.csv", "Time (s),Axial Strain (%),axial_stress_MPa,x\n1,2,3,4\n2,3,4,5\n"));
    const auto strain = input::match_column(t, {"axial strain", {"strain", "axial strain"}, Unit::none, 1.0});
    REQUIRE(strain);
    CHECK(strain->index == 1);
    CHECK(strain->factor == 0.01);
    CHECK(strain->said == "read 'Axial Strain (%)' as axial strain, in %");
    const auto stress = input::match_column(t, {"axial stress", {"axial stress"}, Unit::pressure, 1.0});
    REQUIRE(stress);
    CHECK(stress->factor == 1e6);
    CHECK_FALSE(input::match_column(t, {"radius", {"r"}, Unit::length, 1.0}));
    CHECK(holds(refusal([&] { (void)input::match_column(t, {"length", {"axial strain"}, Unit::length, 1.0}); }), "has the unit %"));
    CHECK(input::unit_factor("N/mm²", Unit::pressure) == 1e6);
    CHECK(input::unit_factor("microstrain", Unit::none) == 1e-6);
    CHECK_FALSE(input::unit_factor("MPa", Unit::length));
}

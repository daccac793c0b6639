// What a run hands to the reports: plain tables, scalars with unit and formula, badges. Reports know these and no test.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace proveta::report {

/// A named column with its unit, e.g. {"axial_stress", "Pa", "mean of both platens ..."}.
struct Column {
    std::string name;
    std::string unit;
    std::string meaning;

    /// Heading as in the CSV files: "axial_stress_Pa".
    [[nodiscard]] std::string heading() const { return unit.empty() ? name : name + "_" + unit; }
};

/// Rows of numbers under named columns.
struct Table {
    std::vector<Column> columns;
    std::vector<std::vector<double>> rows;
    std::vector<std::string> notes; ///< conventions, one a line

    [[nodiscard]] std::size_t column(const std::string& name) const; ///< throws std::out_of_range
    [[nodiscard]] std::vector<double> values(const std::string& name) const;
};

/// A derived result. Without a value it could not be determined, and `formula` says what it would have been.
struct Scalar {
    std::string name;
    std::string title;
    std::optional<double> value;
    std::string unit;
    std::string formula;
};

/// A result in the unit that people use: stresses in MPa, moduli and slopes from 0.1 GPa on in GPa, strains and relative changes in %. The
/// rest in its own unit, as it is printed: m².
Scalar readable(Scalar scalar);

/// A number to be read: three significant digits and no power of ten where it does without, of a whole number all digits. Empty when it is
/// no number.
std::string three_digits(double value);

/// A relative change in per cent with its sign; that of more than tenfold as a factor.
std::string relative_change(double change);

/// Whether a result can be compared by ratios: not where zero has no meaning of its own, as in the logarithms that magnitudes are, or where
/// it is what one hopes for, as of an error.
bool has_ratios(const std::string& name);

/// The unit that suits the largest of several values of a result, so that they can be compared.
struct InUnit {
    std::string unit;
    double factor = 1.0; ///< from SI

    InUnit(const Scalar& scalar, const std::vector<double>& values);
    [[nodiscard]] std::string text(double value) const { return three_digits(value * factor); }
};

/// A judgement with its figures.
struct Badge {
    std::string name;
    bool good = false;
    std::string verdict;                                      ///< one sentence
    std::vector<std::pair<std::string, std::string>> figures; ///< what was found against what is allowed
};

/// How a curve is drawn. Bars stand on y = 0 about their x; those of several curves stand side by side.
enum class CurveStyle { solid, dashed, points, bars };

/// A curve of a plot. Without a name it has no line in the key.
struct Curve {
    std::string name;
    std::vector<double> x, y;
    std::string colour = "#1f4e79";
    CurveStyle style = CurveStyle::solid;
    double width = 1.8; ///< of the line, in pixels
};

/// Gives a curve the colour and style by which the k-th of many is told from the others.
void tell_apart(Curve& curve, std::size_t k);

/// A plot: curves with axis titles in the units of the page.
struct Plot {
    std::string title;
    std::string x_title, y_title;
    std::vector<Curve> curves;
    std::vector<std::pair<double, double>> marks; ///< points to mark
    bool equal_scale = false;                     ///< a unit is as long on both axes
    bool x_from_zero = true;                      ///< the x axis reaches to 0
    bool y_from_zero = true;                      ///< the y axis does
    std::vector<std::string> rows = {};           ///< names of rows at y = -1, -2, ... in place of a y axis with numbers
};

/// A line (crack, surface) or dot (sphere) of a specimen picture, in the plane of the cut, m.
struct PictureDot {
    double x, z, radius, value; ///< value 0 to 1 colours it
};
struct PictureLine {
    double x0, z0, x1, z1;
    int mode;      ///< 0: a surface, 1: a bond failed in tension, 2: in shear
    double weight; ///< how wide the crack is, 0 to 1
};

/// A facet of a surface seen from outside, in the plane of the picture, m.
struct PictureFacet {
    std::vector<std::pair<double, double>> corner;
    double value; ///< 0 to 1 colours it
    double light; ///< 0 to 1: how it faces the light
};

/// A cut through a specimen, or a view of it.
struct Picture {
    std::string title;
    std::string caption;
    double width = 0.0, height = 0.0; ///< m
    std::vector<PictureDot> dots;
    std::vector<PictureLine> lines;
    std::vector<PictureFacet> facets = {}; ///< drawn first, in their order
};

/// A drawing as the bytes of a PNG file.
struct Portrait {
    std::string title;
    std::string caption; ///< what the colours mean
    std::string alt;     ///< in words, for who cannot see it
    std::string png;
};

/// Weights of directions, drawn as sectors about a centre.
struct Rose {
    struct Part {
        std::string name;
        std::string colour;
        std::vector<double> weight; ///< one a sector, all sectors as wide
    };

    std::string title;
    std::string about;          ///< what the angle is
    double turn = 90.0;         ///< angle that the sectors share, from 0, degrees: 90, 180 or 360
    std::vector<Part> parts;    ///< stacked from the centre outwards
    std::vector<double> even;   ///< weights to compare with, drawn as an outline; may be empty
    std::string even_name = {}; ///< what they are
};

/// A result that stands at the head of the page, as a large figure.
struct KeyFigure {
    std::string label;
    std::string value;
    std::string unit = {};
    std::string note = {}; ///< a few words: how it is found, or between which bounds it lies
};

/// A result as a key figure, in the unit that people use; "not determined" without a value.
KeyFigure key_figure(const Scalar& scalar);

/// The first few of the named results that have a value.
std::vector<KeyFigure> key_figures(const std::vector<Scalar>& results, const std::vector<std::string>& names, std::size_t most = 4);

/// A table of texts with a heading.
struct TextTable {
    std::string title;
    std::vector<std::vector<std::string>> rows; ///< the first row is the heading
    std::vector<std::string> links = {};        ///< where the first cells of the rows below the heading lead, relative; empty: nowhere
};

/// A part of the page below a heading of its own.
struct Section {
    std::string title;
    std::string about; ///< a paragraph
    std::vector<Plot> plots = {};
    std::vector<Rose> roses = {};
    std::vector<TextTable> tables = {};
};

/// Everything that a page shows, in this order but for the results, which stand below the curves.
struct Record {
    std::string title;
    std::string subtitle;
    std::string status; ///< complete, interrupted or failed
    std::string stopped_by;
    std::vector<KeyFigure> key_figures;
    std::vector<TextTable> overview; ///< tables above the curves
    std::vector<Scalar> results;
    std::vector<Badge> badges;
    std::vector<std::string> warnings;
    std::vector<Plot> plots;
    std::vector<Portrait> portraits;
    std::vector<Picture> pictures;
    std::vector<Section> sections;
    std::vector<TextTable> tables;
    std::string citation; ///< how to cite what the page shows
};

} // namespace proveta::report

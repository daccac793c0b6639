// Surfaces of PLY files.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <stdexcept>

#include "core/input/words.hpp"
#include "specimens/ply_header.hpp"
#include "specimens/solid_content.hpp"
#include "specimens/surface_content.hpp"

namespace proveta::surface_files {

namespace {

using input::shown;
using solid_files::parse;

class PlyReader {
  public:
    explicit PlyReader(const std::string& file) : file_(file), text_(solid_files::text_of(file)), header_(read_ply_header(text_, file)) {
        at_ = header_.end;
        line_ = header_.lines;
    }

    Faces read() {
        for (const PlyElement& kind : header_.elements) {
            const bool known = kind.name == "vertex" || kind.name == "face" || kind.name == "tristrips";
            for (number_ = 1; number_ <= kind.number; ++number_) {
                kind_ = &kind;
                begin_element();
                read_element(kind);
                end_element();
            }
            if (!known && kind.number > 0) {
                out_.notes.push_back(fmt::format("{} elements {} were passed over", kind.number, shown(kind.name)));
            }
        }
        look_at_the_rest();
        refuse(file_, problems_);
        return std::move(out_);
    }

  private:
    [[nodiscard]] std::string here() const {
        return header_.binary ? fmt::format("{} {}", kind_->name, number_) : fmt::format("line {}: {} {}", line_, kind_->name, number_);
    }
    [[noreturn]] void fail(const std::string& what) {
        problems_.push_back(here() + ": " + what);
        refuse(file_, problems_);
        throw std::logic_error("a refusal without a problem");
    }
    [[nodiscard]] std::size_t left() const { return text_.size() - at_; }

    // The next line with text; false at the end of the file.
    bool next_line() {
        do {
            if (at_ >= text_.size()) {
                return false;
            }
            const std::size_t end = std::min(text_.find_first_of("\r\n", at_), text_.size());
            words_ = input::words_of(std::string_view(text_).substr(at_, end - at_));
            at_ = std::min(end + (text_.compare(end, 2, "\r\n") == 0 ? 2 : 1), text_.size());
            ++line_;
        } while (words_.empty());
        return true;
    }
    // An element of a text has a line of its own, unless it has no properties.
    void begin_element() {
        word_ = 0;
        words_.clear();
        if (!header_.binary && !kind_->properties.empty() && !next_line()) {
            fail(fmt::format("the file ends before it, and {} are announced: it is cut short", kind_->number));
        }
    }
    void end_element() {
        if (word_ != words_.size()) {
            fail(fmt::format("{} numbers are expected and {} were found", word_, words_.size()));
        }
    }

    template <class Number> double binary() {
        if (left() < sizeof(Number)) {
            fail(fmt::format("the file ends in it, and {} are announced: it is cut short", kind_->number));
        }
        char bytes[sizeof(Number)];
        std::copy_n(text_.data() + at_, sizeof(Number), bytes);
        at_ += sizeof(Number);
        if (header_.turned) {
            std::reverse(std::begin(bytes), std::end(bytes));
        }
        Number value;
        std::memcpy(&value, bytes, sizeof value);
        return static_cast<double>(value);
    }
    double number(PlyType type) {
        if (header_.binary) {
            switch (type) {
            case PlyType::int8: return binary<std::int8_t>();
            case PlyType::uint8: return binary<std::uint8_t>();
            case PlyType::int16: return binary<std::int16_t>();
            case PlyType::uint16: return binary<std::uint16_t>();
            case PlyType::int32: return binary<std::int32_t>();
            case PlyType::uint32: return binary<std::uint32_t>();
            case PlyType::float32: return binary<float>();
            case PlyType::float64: return binary<double>();
            }
        }
        double value = 0.0;
        if (word_ >= words_.size() || !parse(words_[word_], value)) {
            fail(word_ >= words_.size() ? fmt::format("the line ends after {} numbers, and there should be more", words_.size())
                                        : fmt::format("a number is expected and {} was found", shown(words_[word_])));
        }
        ++word_;
        return value;
    }
    // A length or the number of a vertex; none where it is not whole or not below a bound.
    std::optional<std::size_t> whole(double value, std::size_t below) {
        const bool fits = value >= 0.0 && value < static_cast<double>(below) && value == std::floor(value);
        return fits ? std::optional(static_cast<std::size_t>(value)) : std::nullopt;
    }
    void problem(const std::string& what) { problems_.push_back(here() + ": " + what); }

    void read_element(const PlyElement& kind) {
        Vec3 place = Vec3::Zero();
        for (const PlyProperty& p : kind.properties) {
            if (p.list) {
                read_list(kind, p);
                continue;
            }
            const double value = number(p.type);
            if (kind.name == "vertex" && p.axis) {
                place[*p.axis] = value;
            }
        }
        if (kind.name == "vertex") {
            if (!place.allFinite()) {
                problem(fmt::format("it is at {} {} {}", place.x(), place.y(), place.z()));
            }
            out_.mesh.vertex.push_back(place);
        }
    }
    void read_list(const PlyElement& kind, const PlyProperty& p) {
        const double length = number(p.count);
        const auto values = whole(length, left() + words_.size() + 1);
        if (!values) {
            fail(fmt::format("the length of the list {} is {}, which there cannot be", p.name, length));
        }
        std::vector<std::uint32_t> vertices;
        for (std::size_t k = 0; k < *values; ++k) {
            const double value = number(p.type);
            if (!p.vertices) {
                continue;
            }
            if (kind.name == "tristrips" && value == -1.0) { // another strip follows
                add_faces(kind, vertices);
                vertices.clear();
            } else if (const auto index = whole(value, header_.vertices)) {
                vertices.push_back(static_cast<std::uint32_t>(*index));
            } else {
                problem(fmt::format("its vertex {} is {}, and there are {} from 0 on", k + 1, value, header_.vertices));
            }
        }
        if (p.vertices) {
            add_faces(kind, vertices);
        }
    }
    void add_faces(const PlyElement& kind, const std::vector<std::uint32_t>& vertices) {
        if (kind.name == "tristrips") {
            add_strip(out_.mesh, vertices);
        } else {
            out_.mesh.add(vertices);
        }
        if (!header_.binary) {
            out_.line.resize(out_.mesh.faces(), line_);
        }
    }

    // What stands behind the last element.
    void look_at_the_rest() {
        if (!header_.binary && next_line()) {
            problems_.push_back(fmt::format("line {}: {} follows the last element that the header announces", line_, shown(words_[0])));
        } else if (header_.binary &&
                   std::string_view(text_).find_first_not_of(std::string_view(" \t\r\n\0", 5), at_) != std::string::npos) {
            out_.notes.push_back(fmt::format("{} bytes behind the last element that the header announces were passed over", left()));
        }
    }

    std::string file_;
    std::string text_;
    PlyHeader header_;
    const PlyElement* kind_ = nullptr;
    std::size_t number_ = 0; // of the element, from 1
    std::size_t at_ = 0;
    std::size_t line_ = 0;
    std::vector<std::string_view> words_; // of a text's line
    std::size_t word_ = 0;
    std::vector<std::string> problems_;
    Faces out_;
};

} // namespace

Faces read_ply(const std::string& file) { return PlyReader(file).read(); }

} // namespace proveta::surface_files

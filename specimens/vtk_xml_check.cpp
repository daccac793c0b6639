#include "specimens/vtk_xml_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <stdexcept>
#include <vector>

#include "core/input/words.hpp"
#include "specimens/solid_content.hpp"
#include "specimens/vtk_xml_tags.hpp"

namespace proveta::vtk {

namespace {

using input::blanks;
using input::shown;
using solid_files::parse;

constexpr double densest = 1100.0; // bytes that a compressor makes of one, at most

// A file's text and how its arrays are written.
class XmlCheck {
  public:
    explicit XmlCheck(const std::string& text) : all_(text), tags_(xml_tags(all_)) {
        if (tags_.empty() || tags_.front().name != "VTKFile") {
            fail("cannot be read (it is no file of VTK's)");
        }
        const XmlTag& head = tags_.front();
        word_ = plain(head, "header_type") == "UInt64" ? 8 : 4;
        big_ = plain(head, "byte_order") == "BigEndian";
        compressed_ = head.has("compressor");
    }

    // Counts that are none, or that no file of this size could hold, even compressed.
    void check_counts() const {
        for (const XmlTag& tag : tags_) {
            for (const std::string_view name : {"NumberOfPoints", "NumberOfCells", "NumberOfVerts", "NumberOfLines", "NumberOfStrips",
                                                "NumberOfPolys", "NumberOfComponents", "NumberOfTuples"}) {
                double value = 0.0;
                if (tag.has(name) && (!parse(tag.value(name), value) || !(value >= 0.0) || value > densest * size())) {
                    fail(fmt::format("{} is {}, which a file of {} bytes cannot hold", name, shown(tag.value(name)), all_.size()));
                }
            }
        }
    }

    // Sizes in front of arrays of bytes, and where the cells of a section end in the list of their points: the length that VTK's reader
    // gives that list. Ends of compressed arrays are not looked at: they would have to be decompressed. An element of any name may be
    // read as an array, and what has an offset is read from the appended data, whatever its format says.
    void check_arrays() const {
        const Bytes data = appended();
        for (const XmlTag& tag : tags_) {
            const std::string_view format = plain(tag, "format");
            const std::string_view name = tag.value("Name");
            const bool ends = name == "offsets" || name.find("&#") != std::string_view::npos; // which may be the same
            if (tag.has("offset") || format == "appended") {
                std::size_t offset = 0;
                if (format != "appended" || !parse(tag.value("offset"), offset) || data.at == all_.size()) {
                    fail("an array with an offset is not in the appended data, or has none there");
                }
                check_bytes({offset < all_.size() - data.at ? data.at + offset : all_.size(), data.raw}, word_of(tag), ends);
            } else if (format == "binary") {
                check_bytes({all_.find_first_not_of(blanks, tag.data), false}, word_of(tag), ends);
            } else if (!format.empty() && format != "ascii") {
                fail(fmt::format("the format {} is none of ascii, binary and appended", shown(format)));
            } else if (ends) {
                check_numbers(tag.data);
            }
        }
    }

  private:
    // Where an array's bytes begin, and whether they stand there as they are or in base64.
    struct Bytes {
        std::size_t at;
        bool raw;
    };

    [[noreturn]] static void fail(const std::string& what) { throw std::runtime_error(what); }
    // A value that stands there as it is.
    [[nodiscard]] static std::string_view plain(const XmlTag& tag, std::string_view attribute) {
        const auto value = tag.value(attribute);
        if (value.find('&') != std::string_view::npos) {
            fail(fmt::format("{} is {}, whose characters are expected as they are", attribute, shown(value)));
        }
        return value;
    }
    [[nodiscard]] double size() const { return static_cast<double>(all_.size()); }

    // Behind the underscore that appended data begin with; the file's end where there are none.
    [[nodiscard]] Bytes appended() const {
        const XmlTag& last = tags_.back();
        if (last.name != "AppendedData") {
            return {all_.size(), false};
        }
        const auto encoding = last.value("encoding");
        const auto first = std::min(all_.find_first_not_of(blanks, last.data), all_.size());
        if ((encoding != "raw" && encoding != "base64") || all_.substr(first, 1) != "_") {
            fail("appended data are expected to be raw or base64, and to begin with an underscore");
        }
        return {first + 1, encoding == "raw"};
    }

    // Bytes of an array's values, which end their type's name in bits.
    [[nodiscard]] static std::size_t word_of(const XmlTag& tag) {
        const std::string_view type = plain(tag, "type");
        return type.ends_with("64") ? 8 : type.ends_with("32") ? 4 : type.ends_with("16") ? 2 : 1;
    }

    // None beyond the end, or where base64 ends.
    [[nodiscard]] std::optional<unsigned> byte(const Bytes& b, std::size_t k) const {
        if (b.raw) {
            return b.at + k < all_.size() ? std::optional(static_cast<unsigned>(static_cast<unsigned char>(all_[b.at + k]))) : std::nullopt;
        }
        constexpr std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
        const std::size_t first = b.at + k / 3 * 4 + k % 3;
        if (first + 1 >= all_.size()) {
            return std::nullopt;
        }
        const auto one = letters.find(all_[first]);
        const auto two = letters.find(all_[first + 1]);
        if (one == std::string_view::npos || two == std::string_view::npos) {
            return std::nullopt;
        }
        return static_cast<unsigned>((one << (2 * (k % 3 + 1)) | two >> (4 - 2 * (k % 3))) & 255U);
    }
    // The whole number of `size` bytes that begins at one of them.
    [[nodiscard]] std::optional<double> number(const Bytes& b, std::size_t begin, std::size_t size) const {
        double value = 0.0;
        for (std::size_t k = 0; k < size; ++k) {
            const auto one = byte(b, begin + (big_ ? k : size - 1 - k));
            if (!one) {
                return std::nullopt;
            }
            value = 256.0 * value + *one;
        }
        return value;
    }
    [[nodiscard]] std::optional<double> word(const Bytes& b, std::size_t k) const { return number(b, k * word_, word_); }

    // Of an array: its bytes; or blocks, their size, that of the last one, and what they are compressed to. What is not there the reader
    // will miss.
    void check_bytes(const Bytes& b, std::size_t value_size, bool ends) const {
        const auto first = word(b, 0);
        if (first.value_or(0.0) > size()) {
            fail(fmt::format("{:.0f} bytes or blocks are announced, which a file of {} bytes cannot hold", *first, all_.size()));
        }
        if (!first) {
            return;
        }
        if (compressed_) {
            check_blocks(b, *first, static_cast<double>(value_size));
        } else if (ends) { // any may be the last that is read
            for (std::size_t k = 0; k < static_cast<std::size_t>(*first) / value_size; ++k) {
                check_end(number(b, word_ + k * value_size, value_size).value_or(0.0));
            }
        }
    }
    void check_blocks(const Bytes& b, double blocks, double value_size) const {
        if (const auto block = word(b, 1); blocks > 0.0 && block && *block < value_size) { // by which the reader divides
            fail(fmt::format("blocks of {:.0f} bytes are announced, less than a value takes", *block));
        }
        for (const std::size_t k : {1U, 2U}) {
            if (const double block = word(b, k).value_or(0.0); blocks * block > densest * size()) {
                fail(fmt::format("{:.0f} blocks of {:.0f} bytes are announced, which a file of {} bytes cannot hold", blocks, block,
                                 all_.size()));
            }
        }
        for (std::size_t k = 0; k < static_cast<std::size_t>(blocks); ++k) {
            const auto packed = word(b, 3 + k);
            if (!packed) {
                return;
            }
            if (*packed > size()) {
                fail(fmt::format("a block of {:.0f} bytes is announced, which a file of {} bytes cannot hold", *packed, all_.size()));
            }
        }
    }
    // The numbers that stand as text up to the next tag: any may be the last that is read.
    void check_numbers(std::size_t from) const {
        for (const auto word : input::words_of(all_.substr(from, std::min(all_.find('<', from), all_.size()) - from))) {
            double value = 0.0; // which may be followed by anything, where VTK's reader stops
            if (std::from_chars(word.data(), word.data() + word.size(), value).ec == std::errc()) {
                check_end(value);
            }
        }
    }
    void check_end(double last) const {
        if (last > size()) {
            fail(fmt::format("the cells' last offset is {:.0f}, and a file of {} bytes cannot list so many points", last, all_.size()));
        }
    }

    std::string_view all_;
    std::vector<XmlTag> tags_;
    std::size_t word_ = 4;
    bool big_ = false;
    bool compressed_ = false;
};

} // namespace

void check_xml(const std::string& file) {
    const std::string text = solid_files::text_of(file);
    try {
        const XmlCheck xml(text);
        xml.check_counts();
        xml.check_arrays();
    } catch (const std::runtime_error& e) {
        throw std::runtime_error(file + ": " + e.what());
    }
}

} // namespace proveta::vtk

#include "specimens/vtk_xml_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <stdexcept>

#include "specimens/solid_content.hpp"

namespace proveta::vtk {

namespace {

using solid_files::parse;
using solid_files::shown;
using solid_files::space;

constexpr double densest = 1100.0; // bytes that a compressor makes of one, at most

// A file's text and how its arrays are written.
class XmlCheck {
  public:
    explicit XmlCheck(const std::string& file) : file_(file), text_(solid_files::text_of(file)), all_(text_) {
        const std::string_view head = tag_at(all_.find("<VTKFile"));
        word_ = attribute(head, "header_type") == "UInt64" ? 8 : 4;
        big_ = attribute(head, "byte_order") == "BigEndian";
        compressed_ = !attribute(head, "compressor").empty();
    }

    // Counts that are none, or that no file of this size could hold, even compressed.
    void check_counts() const {
        for (const std::string_view name : {"NumberOfPoints", "NumberOfCells", "NumberOfVerts", "NumberOfLines", "NumberOfStrips",
                                            "NumberOfPolys", "NumberOfComponents", "NumberOfTuples"}) {
            for (auto at = all_.find(name); at != std::string_view::npos; at = all_.find(name, at + 1)) {
                const auto found = quoted(at + name.size());
                double value = 0.0;
                if (found && (!parse(*found, value) || !(value >= 0.0) || value > densest * size())) {
                    fail(fmt::format("{} is {}, which a file of {} bytes cannot hold", name, shown(*found), all_.size()));
                }
            }
        }
    }

    // Sizes in front of arrays of bytes, and where the cells of a section end in the list of their points: the length that VTK's reader
    // gives that list. Ends of compressed arrays are not looked at: they would have to be decompressed.
    void check_arrays() const {
        const auto appended = all_.find("<AppendedData");
        const bool raw = attribute(tag_at(appended), "encoding") == "raw";
        const auto data = appended == std::string_view::npos ? appended : all_.find('_', appended);
        for (auto at = all_.find("<DataArray"); at < appended; at = all_.find("<DataArray", at + 1)) {
            const std::string_view tag = tag_at(at);
            const std::string_view format = attribute(tag, "format");
            const bool ends = attribute(tag, "Name") == "offsets";
            std::size_t offset = 0;
            if (format == "binary") {
                check_bytes({all_.find_first_not_of(space, at + tag.size()), false}, word_of(tag), ends);
            } else if (format == "appended" && parse(attribute(tag, "offset"), offset) && data != std::string_view::npos) {
                check_bytes({offset < all_.size() - data ? data + 1 + offset : all_.size(), raw}, word_of(tag), ends);
            } else if (format == "ascii" && ends) {
                check_last_number(at + tag.size());
            }
        }
    }

  private:
    [[noreturn]] void fail(const std::string& what) const { throw std::runtime_error(file_ + ": " + what); }
    [[nodiscard]] double size() const { return static_cast<double>(all_.size()); }

    // From a tag's "<" to behind its ">".
    [[nodiscard]] std::string_view tag_at(std::size_t at) const {
        return at >= all_.size() ? std::string_view() : all_.substr(at, std::min(all_.find('>', at), all_.size() - 1) + 1 - at);
    }
    // What stands in quotes behind an equals sign.
    [[nodiscard]] std::optional<std::string_view> quoted(std::size_t at) const {
        const auto open = all_.find_first_not_of("= \t\r\n", at);
        if (open >= all_.size() || (all_[open] != '"' && all_[open] != '\'')) {
            return std::nullopt;
        }
        const auto close = all_.find(all_[open], open + 1);
        return close == std::string_view::npos ? std::nullopt : std::optional(all_.substr(open + 1, close - open - 1));
    }
    [[nodiscard]] std::string_view attribute(std::string_view tag, std::string_view name) const {
        const auto at = tag.find(name);
        return at == std::string_view::npos
                   ? std::string_view()
                   : quoted(static_cast<std::size_t>(tag.data() - all_.data()) + at + name.size()).value_or(std::string_view());
    }

    // Bytes of an array's values, which end their type's name in bits.
    [[nodiscard]] std::size_t word_of(std::string_view tag) const {
        const std::string_view type = attribute(tag, "type");
        return type.ends_with("64") ? 8 : type.ends_with("32") ? 4 : type.ends_with("16") ? 2 : 1;
    }

    // Where an array's bytes begin, and whether they stand there as they are or in base64.
    struct Bytes {
        std::size_t at;
        bool raw;
    };
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
        } else if (const auto bytes = static_cast<std::size_t>(*first); ends && bytes >= value_size) {
            check_end(number(b, word_ + (bytes / value_size - 1) * value_size, value_size).value_or(0.0));
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
    // The last of the numbers that stand as text up to the next tag.
    void check_last_number(std::size_t from) const {
        const auto values = all_.substr(from, std::min(all_.find('<', from), all_.size()) - from);
        const auto last = values.find_last_not_of(space);
        if (last == std::string_view::npos) {
            return;
        }
        const auto before = values.find_last_of(space, last);
        if (double value = 0.0; parse(values.substr(before + 1, last - before), value)) { // of npos: from the first
            check_end(value);
        }
    }
    void check_end(double last) const {
        if (last > size()) {
            fail(fmt::format("the cells' last offset is {:.0f}, and a file of {} bytes cannot list so many points", last, all_.size()));
        }
    }

    std::string file_;
    std::string text_;
    std::string_view all_;
    std::size_t word_ = 4;
    bool big_ = false;
    bool compressed_ = false;
};

} // namespace

void check_xml(const std::string& file) {
    const XmlCheck xml(file);
    xml.check_counts();
    xml.check_arrays();
}

} // namespace proveta::vtk

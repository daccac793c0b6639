// What files of VTK's XML formats announce, before its readers make room for it.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <stdexcept>

#include "specimens/solid_content.hpp"
#include "specimens/vtk_check.hpp"

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

    // Sizes in front of arrays of bytes.
    void check_arrays() const {
        const auto appended = all_.find("<AppendedData");
        const bool raw = attribute(tag_at(appended), "encoding") == "raw";
        const auto data = appended == std::string_view::npos ? appended : all_.find('_', appended);
        for (auto at = all_.find("<DataArray"); at < appended; at = all_.find("<DataArray", at + 1)) {
            const std::string_view tag = tag_at(at);
            const std::string_view format = attribute(tag, "format");
            std::size_t offset = 0;
            if (format == "binary") {
                check_sizes(all_.find_first_not_of(space, at + tag.size()), false, word_of(tag));
            } else if (format == "appended" && parse(attribute(tag, "offset"), offset) && data != std::string_view::npos) {
                check_sizes(offset < all_.size() - data ? data + 1 + offset : all_.size(), raw, word_of(tag));
            }
        }
    }

    // Where the cells of a section end in the list of their points: the length that VTK's reader gives that list. Of text only: the rest
    // would have to be decompressed.
    void check_offsets() const {
        for (auto at = all_.find("\"offsets\""); at != std::string_view::npos; at = all_.find("\"offsets\"", at + 1)) {
            const auto begin = all_.rfind('<', at);
            const std::string_view tag = tag_at(begin);
            if (begin == std::string_view::npos || attribute(tag, "format") != "ascii") {
                continue;
            }
            const std::size_t from = begin + tag.size();
            const auto values = all_.substr(from, std::min(all_.find('<', from), all_.size()) - from);
            const auto last = values.find_last_not_of(space);
            if (last == std::string_view::npos) {
                continue;
            }
            const auto before = values.find_last_of(space, last);
            const auto word = values.substr(before + 1, last - before); // of npos: from the first
            if (double value = 0.0; parse(word, value) && value > size()) {
                fail(fmt::format("the cells' last offset is {}, and a file of {} bytes cannot list so many points", shown(word),
                                 all_.size()));
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
    [[nodiscard]] double word_of(std::string_view tag) const {
        const std::string_view type = attribute(tag, "type");
        return type.ends_with("64") ? 8.0 : type.ends_with("32") ? 4.0 : type.ends_with("16") ? 2.0 : 1.0;
    }

    // Byte of what begins at `at`; none beyond the end, or where base64 ends.
    [[nodiscard]] std::optional<unsigned> byte(std::size_t at, std::size_t k, bool raw) const {
        if (raw) {
            return at + k < all_.size() ? std::optional(static_cast<unsigned>(static_cast<unsigned char>(all_[at + k]))) : std::nullopt;
        }
        constexpr std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
        const std::size_t first = at + k / 3 * 4 + k % 3;
        if (first + 1 >= all_.size()) {
            return std::nullopt;
        }
        const auto a = letters.find(all_[first]);
        const auto b = letters.find(all_[first + 1]);
        if (a == std::string_view::npos || b == std::string_view::npos) {
            return std::nullopt;
        }
        return static_cast<unsigned>((a << (2 * (k % 3 + 1)) | b >> (4 - 2 * (k % 3))) & 255U);
    }
    [[nodiscard]] std::optional<double> word(std::size_t at, std::size_t number, bool raw) const {
        double value = 0.0;
        for (std::size_t k = 0; k < word_; ++k) {
            const auto one = byte(at, number * word_ + (big_ ? k : word_ - 1 - k), raw);
            if (!one) {
                return std::nullopt;
            }
            value = 256.0 * value + *one;
        }
        return value;
    }
    // Of an array: its bytes; or blocks, their size, that of the last one, and what they are compressed to. What is not there the reader
    // will miss.
    void check_sizes(std::size_t at, bool raw, double word_size) const {
        const auto first = word(at, 0, raw);
        if (first.value_or(0.0) > size()) {
            fail(fmt::format("{:.0f} bytes or blocks are announced, which a file of {} bytes cannot hold", *first, all_.size()));
        }
        if (!compressed_ || !first) {
            return;
        }
        if (const auto block = word(at, 1, raw); *first > 0.0 && block && *block < word_size) { // by which the reader divides
            fail(fmt::format("blocks of {:.0f} bytes are announced, less than a value takes", *block));
        }
        for (const std::size_t k : {1U, 2U}) {
            if (const double block = word(at, k, raw).value_or(0.0); *first * block > densest * size()) {
                fail(fmt::format("{:.0f} blocks of {:.0f} bytes are announced, which a file of {} bytes cannot hold", *first, block,
                                 all_.size()));
            }
        }
        for (std::size_t k = 0; k < static_cast<std::size_t>(*first); ++k) {
            const auto packed = word(at, 3 + k, raw);
            if (!packed) {
                return;
            }
            if (*packed > size()) {
                fail(fmt::format("a block of {:.0f} bytes is announced, which a file of {} bytes cannot hold", *packed, all_.size()));
            }
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
    xml.check_offsets();
}

} // namespace proveta::vtk

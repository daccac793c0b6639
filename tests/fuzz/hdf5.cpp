// Specimens and checkpoints. Most changes to an HDF5 file's bytes only tell whether the HDF5 library notices, so that what is in the file
// can also be given as text, one array a line: name, type (d double, i 32 bits, b byte, l 64 bits, t text), values.
#include <charconv>
#include <vector>

#include "specimens/checkpoint.hpp"
#include "specimens/hdf5_file.hpp"
#include "specimens/storage.hpp"
#include "tests/fuzz/scratch.hpp"
#include "tests/fuzz/targets.hpp"

namespace proveta::fuzz {

namespace {

std::string_view cut(std::string_view& text, char at) {
    const std::size_t end = std::min(text.find(at), text.size());
    const std::string_view out = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    return out;
}

template <class Number> std::vector<Number> numbers(std::string_view text) {
    std::vector<Number> out;
    while (!text.empty()) {
        const std::string_view word = cut(text, ' ');
        Number value{};
        std::from_chars(word.data(), word.data() + word.size(), value);
        out.push_back(value);
    }
    return out;
}

// A file of the arrays that the text names. Names that HDF5 has no use for are passed over.
std::string written(std::string_view text) {
    std::string file = scratch_file("made.h5", "");
    Hdf5File out(file, Hdf5File::Mode::create);
    while (!text.empty()) {
        std::string_view line = cut(text, '\n');
        const std::string name(cut(line, ' '));
        const std::string_view type = cut(line, ' ');
        may_refuse([&] {
            if (type == "d") {
                out.put(name, numbers<double>(line));
            } else if (type == "i") {
                out.put(name, numbers<std::int32_t>(line));
            } else if (type == "b") {
                out.put(name, numbers<std::uint8_t>(line));
            } else if (type == "l") {
                const auto values = numbers<std::int64_t>(line);
                out.put(name, values.empty() ? std::int64_t{0} : values.front());
            } else if (type == "t") {
                out.put_text(name, std::string(line));
            }
        });
    }
    out.close();
    return file;
}

// Something of every kind that a checkpoint holds.
void visit_all(StateVisitor& visit) {
    double number = 0.0;
    std::int64_t count = 0;
    std::string text;
    std::vector<double> numbers;
    std::vector<std::int32_t> counts;
    std::vector<std::uint8_t> flags;
    visit("time", number);
    visit("steps", count);
    visit("title", text);
    visit("position_x", numbers);
    visit("contact_i", counts);
    visit("bond_mode", flags);
}

} // namespace

void read_hdf5_file(std::string_view bytes) {
    const std::string file = bytes.starts_with("\x89HDF") ? scratch_file("given.h5", bytes) : written(bytes);
    may_refuse([&] { (void)load_specimen(file); });
    may_refuse([&] { load_checkpoint(file, "a test", visit_all); });
}

} // namespace proveta::fuzz

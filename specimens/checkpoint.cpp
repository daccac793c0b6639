#include "specimens/checkpoint.hpp"

#include <filesystem>
#include <stdexcept>

#include "specimens/hdf5_file.hpp"

namespace proveta {

namespace {

constexpr const char* format_name = "proveta checkpoint 1";

} // namespace

void save_checkpoint(Model& model, const std::string& deck, const std::string& file) {
    const std::string partial = file + ".partial";
    {
        Hdf5File h(partial, Hdf5File::Mode::create);
        h.put_text("format", format_name);
        h.put_text("deck", deck);
        model.visit_state([&](const std::string& name, auto& value) { h.put(name, value); });
        h.close();
    }
    std::filesystem::rename(partial, file);
}

void load_checkpoint(Model& model, const std::string& file) {
    const Hdf5File h(file, Hdf5File::Mode::read);
    if (!h.has("format") || h.get_text("format") != format_name) {
        throw std::runtime_error(file + ": not a checkpoint of this program");
    }
    std::vector<double> x;
    h.get("position_x", x);
    std::vector<std::uint8_t> mode;
    h.get("bond_mode", mode);
    if (x.size() != model.spheres.size() || mode.size() != model.bonds.size()) {
        throw std::runtime_error(file + ": belongs to another specimen");
    }
    model.visit_state([&](const std::string& name, auto& value) { h.get(name, value); });
    model.restored();
}

} // namespace proveta

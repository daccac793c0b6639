// Small specimens for tests.
#pragma once

#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <limits>
#include <stdexcept>

#include "core/model.hpp"
#include "lab/bench.hpp"
#include "lab/verification/brittle.hpp"
#include "lab/verification/unbreakable.hpp"
#include "specimens/checkpoint.hpp"

namespace proveta::testing {

/// A model's state in a file, and back into one that was set up the same way.
inline std::string owner_of(const Model& m) {
    return std::to_string(m.spheres.size()) + " spheres, " + std::to_string(m.bonds.size()) + " bonds";
}
inline void save_model(Model& m, const std::string& file) {
    save_checkpoint(file, owner_of(m), [&](StateVisitor& visit) { m.visit_state(visit); });
}
inline void load_model(Model& m, const std::string& file) {
    load_checkpoint(file, owner_of(m), [&](StateVisitor& visit) { m.visit_state(visit); });
    m.restored();
}

using verification::unbreakable;

/// A folder of its own that goes away with its test, whatever else runs beside it.
class TemporaryFolder {
  public:
    TemporaryFolder() {
        auto name = (std::filesystem::temp_directory_path() / "proveta_XXXXXX").string();
        if (::mkdtemp(name.data()) == nullptr) {
            throw std::runtime_error("no temporary folder");
        }
        path_ = name;
    }
    ~TemporaryFolder() { std::filesystem::remove_all(path_); }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

    /// The path of a file in it; with a text, the file is written.
    [[nodiscard]] std::string file(const std::string& name, const std::string& text = "") const {
        if (!text.empty()) {
            write(name, text);
        }
        return (path_ / name).string();
    }
    void write(const std::string& name, const std::string& text) const { std::ofstream(path_ / name) << text; }

  private:
    std::filesystem::path path_;
};

/// Two equal spheres of radius r that touch, along x, bonded with area pi r^2.
inline Spheres two_spheres(double r, double density = 2500.0) {
    Spheres s;
    s.add({0, 0, 0}, r, density);
    s.add({2 * r, 0, 0}, r, density);
    return s;
}

inline Bonds one_bond(const Spheres& s, const Material& m) {
    std::vector<double> weight;
    return make_bonds(s, {m}, {{0, 1}}, {0, 0}, weight);
}

inline void run(Model& model, int steps) {
    for (int k = 0; k < steps; ++k) {
        model.step({}, k + 1 == steps);
    }
}

/// Problems of a deck given as text.
inline input::Problems problems_of(const std::string& text) {
    try {
        read_deck(input::Json::parse(text), "deck.json");
    } catch (const input::InputError& e) {
        return e.problems;
    }
    return {};
}

/// A deck of a compression test on a small specimen, which softens by ratio: its strengths may be anything.
inline Deck small_deck(int spheres, const std::string& more = "{}") {
    input::Json json = input::Json::parse(R"({"test": "ucs", "specimen": {"diameter": "50 mm", "height": "100 mm"}})");
    json["specimen"]["spheres"] = spheres;
    json["material"] = verification::brittle_strengths();
    json.merge_patch(input::Json::parse(more));
    return read_deck(json, "test.json");
}

} // namespace proveta::testing

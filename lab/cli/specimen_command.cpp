// proveta specimen make|info|export|import
#include <fmt/format.h>
#include <omp.h>
#include <spdlog/spdlog.h>

#include <filesystem>
#include <memory>

#include "core/bonds/bonds.hpp"
#include "core/files/whole_file.hpp"
#include "lab/cli/commands.hpp"
#include "lab/deck.hpp"
#include "lab/progress.hpp"
#include "lab/protocols/registry.hpp"
#include "specimens/import.hpp"
#include "specimens/statistics.hpp"
#include "specimens/storage.hpp"

namespace proveta {

namespace {

// Statistics of the packing, and how well virtual-polyhedron areas fill it at the default coordination.
void print_info(const Specimen& s) {
    const auto st = statistics(s);
    fmt::print("shape                {}\n", s.shape.text());
    if (st.stones > 0) {
        fmt::print("stones               {} of {} forms\n", st.stones, s.forms.size());
    }
    fmt::print("spheres              {}\n", st.spheres);
    fmt::print("mean radius          {:.4f} mm, from {:.4f} to {:.4f}\n", 1e3 * st.mean_radius, 1e3 * st.smallest_radius,
               1e3 * st.largest_radius);
    fmt::print("relative deviation   {:.2f} %\n", 100 * st.relative_deviation);
    fmt::print("porosity             {:.2f} % ({})\n", 100 * st.porosity,
               st.stones > 0 ? "by the stones' volumes" : "overlaps counted twice");
    fmt::print("touching neighbours  {:.3f}\n", st.touching);
    fmt::print("largest overlap      {:.3f} of the smaller radius\n", st.largest_overlap);
    fmt::print("fabric deviator      {:.4f}\n", st.fabric_deviator);
    fmt::print("spheres outside      {}\n", st.outside);
    fmt::print("spheres at the ends  {} below, {} above\n", st.on_lower_end, st.on_upper_end);
    if (st.stones > 0) {
        return; // nothing to bond
    }
    Spheres spheres;
    spheres.planar = s.shape.planar();
    for (std::size_t k = 0; k < s.size(); ++k) {
        spheres.add(s.spheres.centre.at(k), s.spheres.radius[k], 1.0, s.group[k]);
    }
    double beta = 0.0;
    const BondingInput standard;
    try {
        const auto pairs = bonded_pairs(spheres, {0.0, coordination_of(standard, s.shape)}, beta);
        std::vector<double> weight;
        const Bonds bonds = make_bonds(spheres, {Material{}}, pairs, skin_spheres(s), weight);
        const Partition p = partition(s.shape, spheres, bonds);
        fmt::print("bonds                {} at a coordination of {:.4g}, interaction range beta = {:.4f}\n", bonds.size(),
                   2.0 * static_cast<double>(bonds.size()) / static_cast<double>(st.spheres), beta);
        fmt::print("section by areas     {:.4f} of the nominal (interior {:.4f}); sum(A d)/V = {:.4f}\n", p.section, p.interior, p.filling);
    } catch (const std::runtime_error& e) {
        fmt::print("bonds                {}\n", e.what());
    }
}

// Failures of reading and writing a file that the user named are the user's.
template <class F> void on_file(const std::string& file, F&& action) {
    try {
        action();
    } catch (const input::InputError&) {
        throw;
    } catch (const std::runtime_error& e) {
        std::string what = e.what(); // which may begin with the file's name
        if (what.starts_with(file)) {
            what.erase(0, what.find_first_not_of(": ", file.size()));
        }
        throw input::InputError({{file, "", what, "", ""}});
    }
}

struct SpecimenArguments {
    std::string deck;
    std::string in;
    std::string out;
    std::vector<std::string> settings;
    std::string axis = "z";
    ImportOptions import;
    int threads = 0;
};

void add_make(CLI::App& group, const std::shared_ptr<SpecimenArguments>& a, Command& chosen) {
    auto* command = group.add_subcommand("make", "make a specimen by a recipe and store it (.h5)");
    command->add_option("out", a->out, "file to write (.h5)")->required();
    command->add_option("--deck", a->deck, "deck whose \"specimen\" section is the recipe");
    command->add_option("--set", a->settings, "change a value of the recipe: spheres=1000");
    command->add_option("--threads", a->threads, "number of threads; results do not depend on it")->check(CLI::Range(1, 1024));
    command->callback([a, &chosen] {
        chosen = [a] {
            use_threads(a->threads);
            input::Json json = input::Json::object();
            std::unique_ptr<Protocol> test;
            if (!a->deck.empty()) {
                const auto deck = input::load_json(a->deck);
                if (deck.is_object() && deck.contains("test") && deck["test"].is_string()) {
                    test = make_protocol(deck["test"].get<std::string>());
                }
                json = deck.contains("specimen") ? deck["specimen"] : input::Json::object();
            }
            apply_settings(json, a->settings);
            const bool granular = json.is_object() && json.contains("particles"); // which only such recipes have
            SpecimenRecipe recipe = granular ? granular_recipe() : SpecimenRecipe{};
            if (test) {
                test->suggest(recipe);
            }
            input::Problems problems;
            const std::string source = a->deck.empty() ? "recipe" : a->deck;
            const std::string folder = a->deck.empty() ? "." : std::filesystem::absolute(a->deck).parent_path().string();
            read_grading_files(json, folder, source, "", problems);
            input::read(json, recipe, source, "", problems);
            check_recipe(recipe, source, "", problems);
            if (!problems.empty()) {
                throw input::InputError(problems);
            }
            on_file(a->out, [&] { require_writable(a->out); });
            Progress progress(false);
            const Specimen s = obtain_specimen(
                recipe, ".", source, [&](double done) { progress.show(fmt::format("making the specimen  {:.0f} %", 100.0 * done)); });
            progress.end_line();
            on_file(a->out, [&] { save_specimen(s, a->out); });
            print_info(s);
            return 0;
        };
    });
}

void add_info(CLI::App& group, const std::shared_ptr<SpecimenArguments>& a, Command& chosen) {
    auto* command = group.add_subcommand("info", "statistics of a stored specimen");
    command->add_option("file", a->in, "specimen (.h5)")->required();
    command->callback([a, &chosen] {
        chosen = [a] {
            on_file(a->in, [&] { print_info(load_specimen(a->in)); });
            return 0;
        };
    });
}

void add_export(CLI::App& group, const std::shared_ptr<SpecimenArguments>& a, Command& chosen) {
    auto* command = group.add_subcommand("export", "write a stored specimen as x,y,z,r,group lines (m)");
    command->add_option("file", a->in, "specimen (.h5)")->required();
    command->add_option("out", a->out, "file to write (.csv)")->required();
    command->callback([a, &chosen] {
        chosen = [a] {
            on_file(a->in, [&] { export_csv(load_specimen(a->in), a->out); });
            return 0;
        };
    });
}

void add_import(CLI::App& group, const std::shared_ptr<SpecimenArguments>& a, Command& chosen) {
    auto* command =
        group.add_subcommand("import", "read spheres from a table (.csv/.txt/.xyzr/.dat), Kratos .mdpa or GiD .msh and store them (.h5)");
    command->add_option("file", a->in, "file to read")->required();
    command->add_option("out", a->out, "file to write (.h5)")->required();
    command->add_option("--axis", a->axis, "the file's axis that is the specimen's")->check(CLI::IsMember({"x", "y", "z"}));
    command->add_option("--shape", a->import.shape, "cylinder or prism")->check(CLI::IsMember({"cylinder", "prism"}));
    for (const auto& [option, value] : {std::pair{"--diameter", &a->import.diameter},
                                        {"--width", &a->import.width},
                                        {"--depth", &a->import.depth},
                                        {"--height", &a->import.height}}) {
        command->add_option(option, *value, "nominal size in m (default: fitted to the spheres)")->check(CLI::PositiveNumber);
    }
    command->add_option("--scale", a->import.scale, "metres per unit of the file (default: what its headings say, or 1)")
        ->check(CLI::PositiveNumber);
    command->add_option("--columns", a->import.columns,
                        "what a table's columns are, in their order: x,y,z,r or x,y,z,d,-,group (d: diameter, -: not used)");
    command->callback([a, &chosen] {
        chosen = [a] {
            a->import.axis = a->axis.front();
            on_file(a->in, [&] {
                const Imported found = import_specimen(a->in, a->import);
                for (const auto& note : found.notes) {
                    fmt::print("{}\n", note);
                }
                for (const auto& warning : found.warnings) {
                    spdlog::warn("{}", warning);
                }
                save_specimen(found.specimen, a->out);
                print_info(found.specimen);
            });
            return 0;
        };
    });
}

} // namespace

void add_specimen(CLI::App& app, Command& chosen) {
    auto* group = app.add_subcommand("specimen", "make, look at, export and import specimens");
    group->require_subcommand(1);
    const auto a = std::make_shared<SpecimenArguments>();
    add_make(*group, a, chosen);
    add_info(*group, a, chosen);
    add_export(*group, a, chosen);
    add_import(*group, a, chosen);
}

} // namespace proveta

#include "specimens/storage.hpp"

#include <cmath>
#include <filesystem>
#include <stdexcept>

#include "specimens/hdf5_file.hpp"
#include "specimens/statistics.hpp"

namespace proveta {

namespace {

constexpr const char* format_name = "proveta specimen 1";

} // namespace

void save_specimen(const Specimen& s, const std::string& file) {
    const std::string partial = file + ".partial";
    {
        Hdf5File h(partial, Hdf5File::Mode::create);
        h.put_text("format", format_name);
        h.put("x", s.spheres.centre.x);
        h.put("y", s.spheres.centre.y);
        h.put("z", s.spheres.centre.z);
        h.put("radius", s.spheres.radius);
        h.put("group", std::vector<std::int32_t>(s.group.begin(), s.group.end()));
        h.put("shape",
              std::vector<double>{static_cast<double>(s.shape.kind), s.shape.diameter, s.shape.width, s.shape.depth, s.shape.height});
        h.put_text("recipe", s.recipe.dump());
        const SpecimenStatistics st = statistics(s);
        h.put("mean_radius", st.mean_radius);
        h.put("relative_deviation", st.relative_deviation);
        h.put("porosity", st.porosity);
        h.put("touching", st.touching);
        h.put("largest_overlap", st.largest_overlap);
        h.put("fabric_deviator", st.fabric_deviator);
        h.close();
    }
    std::filesystem::rename(partial, file);
}

Specimen load_specimen(const std::string& file) {
    const Hdf5File h(file, Hdf5File::Mode::read);
    if (!h.has("format") || h.get_text("format") != format_name) {
        throw std::runtime_error("not a specimen of this program");
    }
    Specimen s;
    h.get("x", s.spheres.centre.x);
    h.get("y", s.spheres.centre.y);
    h.get("z", s.spheres.centre.z);
    h.get("radius", s.spheres.radius);
    std::vector<std::int32_t> group;
    h.get("group", group);
    s.group.assign(group.begin(), group.end());
    std::vector<double> shape;
    h.get("shape", shape);
    const std::size_t n = s.spheres.radius.size();
    if (n == 0 || s.spheres.centre.x.size() != n || s.spheres.centre.y.size() != n || s.spheres.centre.z.size() != n ||
        s.group.size() != n || shape.size() != 5) {
        throw std::runtime_error("arrays of unequal length");
    }
    if (shape[0] != 0.0 && shape[0] != 1.0 && shape[0] != 2.0) {
        throw std::runtime_error("a shape that this program does not know");
    }
    s.shape.kind = static_cast<ShapeKind>(static_cast<int>(shape[0]));
    s.shape.diameter = shape[1];
    s.shape.width = shape[2];
    s.shape.depth = shape[3];
    s.shape.height = shape[4];
    for (std::size_t k = 0; k < n; ++k) {
        if (!s.spheres.centre.at(k).allFinite() || !(s.spheres.radius[k] > 0.0) || !std::isfinite(s.spheres.radius[k])) {
            throw std::runtime_error("sphere " + std::to_string(k) + " has an impossible centre or radius");
        }
    }
    for (const double x : shape) {
        if (!std::isfinite(x) || x < 0.0) {
            throw std::runtime_error("impossible dimensions");
        }
    }
    s.recipe = input::Json::parse(h.get_text("recipe"), nullptr, false);
    return s;
}

} // namespace proveta

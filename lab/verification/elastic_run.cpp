#include "lab/verification/elastic_run.hpp"

#include <cmath>

#include "lab/derived.hpp"

namespace proveta::verification {

ElasticRun::ElasticRun(const char* test, input::Json specimen, input::Json loading, const input::Json& material) {
    input::Json json = {{"test", test},
                        {"specimen", std::move(specimen)},
                        {"material",
                         {{"card", "custom"},
                          {"sigma_f", "1000 GPa"},
                          {"tau_f", "1000 GPa"},
                          {"lcs", {"1000 GPa", "2000 GPa", "3000 GPa"}},
                          {"fracture_energy_tension", 0},
                          {"fracture_energy_shear", 0}}},
                        {"loading", std::move(loading)},
                        {"output", {{"samples", 60}, {"fields", 0}}}};
    json["material"].update(material);
    const Deck deck = read_deck(json, test);
    Bench bench = set_up(deck, make_specimen(deck.specimen));
    data_ = run_protocol(deck, bench, {[](const TestData&, double) {}, [] {}, [] { return false; }});
    calibrations_ = bench.calibrations;
    ledger_residual_ = std::fabs(bench.model->ledger().relative_residual());
}

double ElasticRun::of(const char* column) const {
    const auto stress = data_.curve.values("axial_stress");
    const auto line = fit(stress, data_.curve.values(column), stress.size() / 2, stress.size() - 1);
    return line ? line->slope : std::nan("");
}

double ElasticRun::worst_ratio(const char* a, const char* b) const {
    const auto x = data_.curve.values(a);
    const auto y = data_.curve.values(b);
    double worst = 0.0;
    for (std::size_t k = 0; k < x.size(); ++k) {
        if (y[k] > 0.1 * y.back()) {
            worst = std::max(worst, std::fabs(x[k] / y[k] - 1.0));
        }
    }
    return worst;
}

} // namespace proveta::verification

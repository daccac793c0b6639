// The outcome of a sweep as JSON and text.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lab/progress.hpp"
#include "lab/sweep/sweep_report.hpp"
#include "lab/trials/verdicts.hpp"

namespace proveta {

using input::Json;

namespace {

Json or_null(double value) { return std::isfinite(value) ? Json(value) : Json(); }

double seconds_of(const SweepTable& table) {
    double out = 0.0;
    for (const auto& trial : table.trials) {
        out += trial.seconds();
    }
    return out;
}

} // namespace

Json sweep_summary(const Sweep& sweep, const SweepOutcome& o, const report::Record& record) {
    Json j;
    j["title"] = record.title;
    j["status"] = record.status;
    j["design"] = sweep.input.design;
    j["points"] = o.table.trials.size();
    j["failed"] = o.table.failed();
    j["results"] = Json::array();
    for (std::size_t c = 0; c < o.table.results.size(); ++c) {
        const auto& column = o.table.results[c];
        Json one{{"test", column.test}, {"result", column.result}, {"unit", column.unit}, {"parameters", Json::object()}};
        for (std::size_t k = 0; k < sweep.space.size(); ++k) {
            const Sensitivity& s = o.sensitivities[c][k];
            Json& of_parameter = one["parameters"][sweep.space[k].name];
            of_parameter["n"] = s.n;
            if (!sweep.trajectories()) {
                of_parameter["rank_correlation"] = or_null(s.value);
                of_parameter["bound_95"] = s.bound;
            } else if (s.n > 0) {
                of_parameter["mu"] = s.effects.mu;
                of_parameter["mu_star"] = s.effects.mu_star;
                of_parameter["sigma"] = or_null(s.effects.sigma);
            }
        }
        j["results"].push_back(std::move(one));
    }
    j["verdicts"] = verdicts_of(o.table.trials);
    j["warnings"] = record.warnings;
    return j;
}

std::string sweep_text(const Sweep& sweep, const SweepOutcome& o, const report::Record& record) {
    std::string out = fmt::format("{} ({}): {}, {} of running time\n", record.title, record.status, record.stopped_by,
                                  Progress::duration(seconds_of(o.table)));
    for (const auto& test : sweep.tests) {
        for (const auto c : main_results(sweep, o.table, test.name)) {
            std::vector<std::string> parts;
            for (const auto k : by_influence(o.sensitivities[c])) {
                if (std::isfinite(o.sensitivities[c][k].value)) {
                    parts.push_back(fmt::format("{} {:.2f}", sweep.space[k].name, o.sensitivities[c][k].value));
                }
            }
            if (!parts.empty()) {
                out += fmt::format("  {:<28} {}\n", o.table.results[c].name(), fmt::join(parts, ", "));
            }
        }
    }
    for (const auto& w : record.warnings) {
        out += fmt::format("  warning: {}\n", w);
    }
    return out;
}

} // namespace proveta

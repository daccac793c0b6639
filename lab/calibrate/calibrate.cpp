#include "lab/calibrate/calibrate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lab/calibrate/search.hpp"
#include "lab/provenance.hpp"
#include "lab/revision.hpp"
#include "lab/trials/decks.hpp"

namespace proveta {

using input::Json;

namespace {

using Point = std::vector<double>;

bool speaks_of(const std::vector<Target>& targets, const std::string& test, bool fitted) {
    return std::any_of(targets.begin(), targets.end(), [&](const Target& t) { return t.input.test == test && t.input.fitted() == fitted; });
}

class Calibration {
  public:
    Calibration(const CalibrationPlan& plan, const std::vector<Target>& targets, TrialBook& book, const CalibrationProgress& progress)
        : plan_(plan), in_(plan.input), targets_(targets), book_(book), progress_(progress) {
        for (auto test : plan.tests) {
            shorten(test, targets);
            if (speaks_of(targets, test.name, true)) {
                fitted_.push_back(std::move(test));
            } else if (speaks_of(targets, test.name, false)) {
                predicted_.push_back(std::move(test));
            }
        }
    }

    CalibrationOutcome run() {
        search(static_cast<std::size_t>(in_.search.trials), "search");
        if (in_.finish.rounds == 0) {
            out_.best = best_small();
        } else {
            finish();
        }
        progress_("predictions", out_);
        if (!predicted_.empty()) {
            out_.predictions = book_.evaluate({trial(predicted_, out_.best_trial().u, 1.0, all_seeds, 0)}, "predictions").front();
        }
        if (in_.confidence.seeds > 0) {
            progress_("confidence", out_);
            out_.confidence = confidence();
        }
        progress_("done", out_);
        return std::move(out_);
    }

  private:
    static constexpr std::size_t all_seeds = 0;

    // The tests on `seeds` specimens each, from number `first` on; seeds that a test has not are counted on from its last.
    [[nodiscard]] Trial trial(const std::vector<TrialTest>& tests, const Point& u, double share, std::size_t seeds,
                              std::size_t first) const {
        Trial t;
        t.values = plan_.space.resolved(plan_.space.values(u));
        for (const auto& test : tests) {
            const std::size_t n = test.seeds.empty() ? 1 : seeds == all_seeds ? test.seeds.size() : seeds;
            for (std::size_t k = first; k < first + n; ++k) {
                const std::size_t own = test.seeds.size();
                const std::int64_t seed =
                    own == 0  ? 0
                    : k < own ? test.seeds[k]
                              : *std::max_element(test.seeds.begin(), test.seeds.end()) + static_cast<std::int64_t>(k - own + 1);
                t.jobs.push_back(job_for(test, seed, share, plan_.space, plan_.space.values(u)));
            }
        }
        return t;
    }

    void add(const std::string& phase, bool whole, const std::vector<Point>& points, const std::string& what) {
        std::vector<Trial> trials;
        for (const auto& u : points) {
            trials.push_back(trial(fitted_, u, whole ? 1.0 : in_.search.spheres, whole ? all_seeds : small_seeds(), 0));
        }
        auto results = book_.evaluate(std::move(trials), what);
        for (std::size_t k = 0; k < points.size(); ++k) {
            CalibrationTrial t{phase, whole, points[k], std::move(results[k]), {}};
            t.deviations = deviations(targets_, t.result, book_.folders());
            out_.trials.push_back(std::move(t));
        }
        progress_(phase, out_);
    }

    [[nodiscard]] std::size_t small_seeds() const { return static_cast<std::size_t>(in_.search.seeds); }

    // Trials on small specimens, corrected by what the last round found.
    [[nodiscard]] std::vector<SearchPoint> samples() const {
        std::vector<SearchPoint> out;
        for (const auto& t : out_.trials) {
            if (!t.whole) {
                out.push_back({t.u, corrected(t.deviations), t.deviations.complete});
            }
        }
        return out;
    }

    [[nodiscard]] std::vector<double> corrected(const Deviations& d) const {
        std::vector<double> out = d.all;
        if (!out_.rounds.empty()) {
            for (std::size_t k = 0; k < out.size(); ++k) {
                out[k] += out_.rounds.back().shift[k];
            }
        }
        return out;
    }

    // What the last trial did not give, and how its tests ended.
    [[nodiscard]] std::string undetermined() const {
        const TrialResult& last = out_.trials.back().result;
        std::vector<std::string> missing;
        for (const auto& target : plan_.input.targets) {
            if (!target.is_curve() && !last.mean(target.test, target.result)) {
                missing.push_back(fmt::format("{} of {}", target.result, target.test));
            }
        }
        std::vector<std::string> ends;
        for (const auto& job : last.jobs) {
            ends.push_back(fmt::format("{}: {}", job.name, job.reason));
        }
        return fmt::format("{} not determined; the tests ended so: {}. A stop rule may end a test before its peak",
                           missing.empty() ? "a curve was" : fmt::format("{} was", fmt::join(missing, ", ")), fmt::join(ends, "; "));
    }

    // Index, among all trials, of the best on small specimens.
    [[nodiscard]] std::size_t best_small() const {
        const auto all = samples();
        const std::size_t best = best_sample(all);
        if (best == all.size()) {
            const auto& jobs = out_.trials.back().result.jobs;
            const auto failed = std::find_if(jobs.begin(), jobs.end(), [](const JobResult& j) { return j.status != "complete"; });
            throw std::runtime_error(fmt::format("none of {} trials gave every target; the last: {}", all.size(),
                                                 failed != jobs.end() ? failed->name + ": " + failed->reason : undetermined()));
        }
        std::size_t small = 0;
        for (std::size_t k = 0; k < out_.trials.size(); ++k) {
            if (!out_.trials[k].whole && small++ == best) {
                return k;
            }
        }
        return out_.trials.size();
    }

    void search(std::size_t trials, const std::string& phase) {
        for (std::size_t done = 0; done < trials;) {
            const auto known = samples();
            const std::size_t best = best_sample(known);
            if (best < known.size() && known[best].score() <= in_.search.good_enough) {
                return;
            }
            const std::size_t count = std::min(static_cast<std::size_t>(in_.search.batch), trials - done);
            const auto seed = static_cast<std::uint64_t>(in_.search.seed) * 1000003u + known.size();
            const std::string score = best < known.size() ? fmt::format(", best score {:.3f}", known[best].score()) : "";
            add(phase, false, propose(known, plan_.space.size(), count, in_.search.method, seed),
                fmt::format("{}, trials {} to {} of {}{}", phase, done + 1, done + count, trials, score));
            done += count;
        }
    }

    void finish() {
        for (std::int64_t r = 0; r < in_.finish.rounds; ++r) {
            const std::size_t small = best_small();
            Round round;
            const SearchPoint expected{{}, corrected(out_.trials[small].deviations), true};
            round.expected = expected.score();
            add("finish", true, {out_.trials[small].u}, fmt::format("round {} of {} on whole specimens", r + 1, in_.finish.rounds));
            round.trial = out_.trials.size() - 1;
            const Deviations& whole = out_.trials.back().deviations;
            round.score = whole.score();
            for (std::size_t k = 0; k < whole.all.size(); ++k) {
                round.shift.push_back(whole.complete ? whole.all[k] - out_.trials[small].deviations.all[k] : 0.0);
            }
            out_.rounds.push_back(std::move(round));
            const auto better = [&](std::size_t a, std::size_t b) {
                const auto& da = out_.trials[a].deviations;
                const auto& db = out_.trials[b].deviations;
                return da.complete != db.complete ? da.complete : da.score() < db.score();
            };
            const std::size_t last = out_.trials.size() - 1;
            out_.best = r == 0 || better(last, out_.best) ? last : out_.best;
            if (r + 1 == in_.finish.rounds || out_.trials[out_.best].deviations.score() <= in_.search.good_enough) {
                return;
            }
            search(static_cast<std::size_t>(in_.finish.trials), "search");
        }
    }

    // Trials on small specimens that are no part of the search.
    std::vector<Deviations> aside(std::vector<Trial> trials, const std::string& what) {
        std::vector<Deviations> out;
        for (const auto& result : book_.evaluate(std::move(trials), what)) {
            out.push_back(deviations(targets_, result, book_.folders()));
        }
        return out;
    }

    Confidence confidence() {
        Confidence c;
        const Point& best = out_.best_trial().u;
        std::vector<Trial> trials;
        for (std::size_t k = 0; k < static_cast<std::size_t>(in_.confidence.seeds); ++k) {
            trials.push_back(trial(fitted_, best, in_.search.spheres, 1, k));
        }
        const auto by_seed = aside(std::move(trials), "noise over specimens");
        const Eigen::MatrixXd covariance = covariance_of(by_seed);
        for (Eigen::Index k = 0; k < covariance.rows(); ++k) {
            c.noise.push_back(std::sqrt(covariance(k, k)));
        }
        c.noise_of_score = std::sqrt(covariance.trace());

        const auto n = plan_.space.size();
        const double step = in_.confidence.step;
        std::vector<Trial> moved{trial(fitted_, best, in_.search.spheres, small_seeds(), 0)};
        std::vector<Point> where{best};
        for (std::size_t p = 0; p < n; ++p) {
            for (const double by : {-step, -0.5 * step, 0.5 * step, step}) {
                Point u = best;
                u[p] = std::clamp(best[p] + by, 0.0, 1.0);
                where.push_back(u);
                moved.push_back(trial(fitted_, u, in_.search.spheres, small_seeds(), 0));
            }
        }
        const auto found = aside(std::move(moved), "profiles");
        c.jacobian.resize(static_cast<Eigen::Index>(found.front().all.size()), static_cast<Eigen::Index>(n));
        for (std::size_t p = 0; p < n; ++p) {
            std::vector<std::size_t> own{1 + 4 * p, 2 + 4 * p, 0, 3 + 4 * p, 4 + 4 * p};
            add_profile(c, p, own, where, found);
        }
        const auto specimens = static_cast<double>(specimens_of_fit());
        analyse_errors(c, covariance / specimens);
        return c;
    }

    // Specimens whose mean was fitted: the fewest of any test.
    [[nodiscard]] std::size_t specimens_of_fit() const {
        std::size_t least = in_.finish.rounds > 0 ? 1000 : small_seeds();
        for (const auto& test : fitted_) {
            least = in_.finish.rounds > 0 ? std::min(least, std::max<std::size_t>(test.seeds.size(), 1)) : least;
        }
        return least;
    }

    static Eigen::MatrixXd covariance_of(const std::vector<Deviations>& samples) {
        std::vector<Eigen::VectorXd> good;
        for (const auto& s : samples) {
            if (s.complete) {
                good.emplace_back(Eigen::Map<const Eigen::VectorXd>(s.all.data(), static_cast<Eigen::Index>(s.all.size())));
            }
        }
        const auto size = static_cast<Eigen::Index>(samples.front().all.size());
        Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(size, size);
        if (good.size() < 2) {
            return covariance;
        }
        Eigen::VectorXd mean = Eigen::VectorXd::Zero(size);
        for (const auto& g : good) {
            mean += g / static_cast<double>(good.size());
        }
        for (const auto& g : good) {
            covariance += (g - mean) * (g - mean).transpose() / static_cast<double>(good.size() - 1);
        }
        return covariance;
    }

    // The profile along one parameter, and the least-squares slope of every deviation along it.
    void add_profile(Confidence& c, std::size_t p, const std::vector<std::size_t>& own, const std::vector<Point>& where,
                     const std::vector<Deviations>& found) const {
        Profile profile;
        double mean = 0.0;
        double spread = 0.0;
        std::vector<std::size_t> good;
        for (const auto k : own) {
            if (!profile.u.empty() && where[k][p] <= profile.u.back()) {
                continue; // cut off by a bound
            }
            profile.u.push_back(where[k][p]);
            const SearchPoint s{{}, corrected(found[k]), true};
            profile.score.push_back(found[k].complete ? s.score() : std::nan(""));
            if (found[k].complete) {
                good.push_back(k);
                mean += where[k][p];
            }
        }
        mean /= static_cast<double>(std::max<std::size_t>(good.size(), 1));
        Eigen::VectorXd slope = Eigen::VectorXd::Zero(c.jacobian.rows());
        for (const auto k : good) {
            spread += (where[k][p] - mean) * (where[k][p] - mean);
            slope += (where[k][p] - mean) * Eigen::Map<const Eigen::VectorXd>(found[k].all.data(), slope.size());
        }
        c.jacobian.col(static_cast<Eigen::Index>(p)) = spread > 0.0 ? Eigen::VectorXd(slope / spread) : slope;
        c.profiles.push_back(std::move(profile));
    }

    const CalibrationPlan& plan_;
    const CalibrationInput& in_;
    const std::vector<Target>& targets_;
    TrialBook& book_;
    const CalibrationProgress& progress_;
    std::vector<TrialTest> fitted_, predicted_;
    CalibrationOutcome out_;
};

} // namespace

CalibrationOutcome calibrate(const CalibrationPlan& plan, const std::vector<Target>& targets, TrialBook& book,
                             const CalibrationProgress& progress) {
    return Calibration(plan, targets, book, progress).run();
}

Json calibrated_card(const CalibrationPlan& plan, const std::vector<Target>& targets, const CalibrationOutcome& outcome,
                     const TrialFolders& folders) {
    const auto& best = outcome.best_trial();
    Json deck = plan.tests.front().deck;
    plan.space.apply(deck, plan.space.values(best.u));
    Json card = deck["material"];
    const std::string base = plan.tests.front().written.value(Json::json_pointer("/material/card"), std::string("the default card"));
    card.erase("card");
    card["name"] = plan.input.card.name;
    card["status"] = plan.input.card.status;
    card["about"] = plan.input.card.about.empty() ? "calibrated from " + base : plan.input.card.about;
    card["source"] = fmt::format("proveta {} calibrate, from {}; evidence below", version(), base);
    Json evidence{{"version", version()},
                  {"revision", git_revision()},
                  {"physics", physics_revision()},
                  {"area_rule", card["area_rule"]},
                  {"score_in_tolerances", best.deviations.score()}};
    evidence["trials"] = outcome.trials.size();
    evidence["whole_specimens"] = best.whole;
    for (std::size_t k = 0; k < plan.space.size(); ++k) {
        Json p{{"path", plan.space[k].path}, {"value", best.result.values[k]}};
        if (outcome.confidence) {
            const auto& space = plan.space[k];
            const double error = outcome.confidence->standard_error[k];
            const double u = best.u[k];
            p["standard_error"] = 0.5 * std::fabs(space.at(u + error) - space.at(u - error)) * best.result.values[k] / space.at(u);
        }
        evidence["parameters"][plan.space[k].name] = p;
    }
    for (const auto& t : targets) {
        const bool in_fit = speaks_of(targets, t.input.test, true);
        const Comparison c = compare(t, in_fit ? best.result : outcome.predictions, folders);
        Json j{{"target", t.input.title()}, {"use", t.input.use}, {"kind", t.input.kind}, {"tolerance", t.input.tolerance}};
        if (!t.input.source.empty()) {
            j["source"] = t.input.source;
        }
        if (!t.input.is_curve()) {
            j["wanted"] = t.input.value;
            j["found"] = c.found ? Json(c.value) : Json();
        }
        j["distance"] = c.found ? Json(c.distance) : Json();
        evidence["targets"].push_back(std::move(j));
    }
    for (const auto& test : plan.tests) {
        evidence["seeds"][test.name] = test.seeds;
        evidence["spheres"][test.name] = test.seeds.empty() ? Json("stored specimen") : test.deck["specimen"]["spheres"];
    }
    card["evidence"] = evidence;
    return card;
}

} // namespace proveta

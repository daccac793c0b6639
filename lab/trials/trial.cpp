#include "lab/trials/trial.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <fstream>
#include <new>
#include <sstream>

#include "core/files/whole_file.hpp"
#include "lab/progress.hpp"
#include "lab/provenance.hpp"
#include "lab/results.hpp"
#include "lab/test_run.hpp"
#include "lab/trials/csv.hpp"
#include "reports/files.hpp"
#include "specimens/storage.hpp"

namespace proveta {

namespace fs = std::filesystem;
using input::Json;

namespace {

std::string bytes_of(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
}

// A specimen made by a recipe, and not a stored one.
bool made(const Json& deck) { return deck["specimen"].value("file", "").empty(); }

void run(const fs::path& folder, JobResult& result) {
    Deck deck = read_deck(input::load_json((folder / "deck.json").string()), (folder / "deck.json").string());
    Bench bench = set_up(deck, obtain_specimen(deck.specimen, deck.folder, deck.source));
    const TestHooks hooks{[](const TestData&, double) {}, [] {}, interrupted};
    TestData data = run_protocol(deck, bench, hooks);
    if (deck.protocol->checks_rate() && data.failure.empty() && !data.interrupted) {
        data.rate_check = check_rate(deck, bench.specimen, data.curve, hooks);
        data.interrupted = !data.rate_check && interrupted();
    }
    result.reason = data.failure.empty() ? data.stopped_by : data.failure;
    result.status = data.interrupted ? "interrupted" : data.failure.empty() ? "complete" : "failed";
    if (result.status != "complete") {
        return;
    }
    const report::Record record = make_record(deck, bench, data, acoustic_events(data.events, acoustic_rule(bench)), result.status);
    for (const auto& scalar : record.results) {
        if (scalar.value && std::isfinite(*scalar.value)) { // JSON knows no others
            result.results[scalar.name] = *scalar.value;
            if (!scalar.unit.empty()) {
                result.units[scalar.name] = scalar.unit;
            }
        }
    }
    result.quasi_static = record.badges.front().good;
    result.verdict = record.badges.front().verdict;
    if (data.rate_check) {
        result.rate_difference = data.rate_check->difference;
    }
    result.sense = bench.press.sense;
    report::write_file((folder / "curve.csv").string(), report::to_csv(data.curve));
}

} // namespace

Json to_json(const JobResult& r) {
    Json j{{"job", r.name},    {"test", r.test},       {"status", r.status},   {"reason", r.reason}, {"quasi_static", r.quasi_static},
           {"sense", r.sense}, {"seconds", r.seconds}, {"results", r.results}, {"units", r.units},   {"of_machine", r.of_machine}};
    j["verdict"] = r.verdict;
    if (r.rate_difference) {
        j["rate_difference"] = *r.rate_difference;
    }
    j["physics"] = r.physics;
    return j;
}

JobResult job_result(const Json& j) {
    JobResult r{j.at("job"),          j.at("test"),  j.at("status"),  j.at("reason"), j.at("results"),
                j.at("quasi_static"), j.at("sense"), j.at("seconds"), j.at("units"),  j.value("of_machine", false)};
    r.verdict = input::text_at(j, "verdict");
    if (j.contains("rate_difference")) {
        r.rate_difference = j["rate_difference"].get<double>();
    }
    r.physics = input::text_at(j, "physics");
    return r;
}

std::string specimen_key(const Json& recipe, const std::string& physics) { return hash_of_text(physics + '\n' + recipe.dump()); }

Trial keyed(Trial trial, const std::string& physics) {
    std::string all = physics;
    for (const auto& job : trial.jobs) {
        all += '\n' + job.name + ' ' + job.deck.dump();
        if (!made(job.deck)) {
            all += bytes_of(job.deck["specimen"]["file"].get<std::string>());
        }
    }
    trial.key = hash_of_text(all);
    return trial;
}

void TrialFolders::look() const {
    if (look_) {
        look_();
    }
}

// None when the deck gives no specimen: then its job fails with the reason, and the other trials go on.
void TrialFolders::make_specimen(const Json& deck, const fs::path& file) const {
    std::optional<Specimen> specimen;
    try {
        const Deck read = read_deck(deck, "deck");
        specimen = obtain_specimen(read.specimen, read.folder, read.source);
    } catch (const FileError&) {
        throw;
    } catch (const std::exception&) {
        return;
    }
    look(); // it may have taken a while
    make_folder(file.parent_path());
    save_specimen(*specimen, file.string());
}

bool TrialFolders::write(const Trial& t) const {
    look();
    const fs::path folder = trial(t.key);
    make_folder(folder.parent_path());
    make_folder(folder);
    Json list = Json::array();
    for (const auto& job : t.jobs) {
        if (interrupted()) {
            return false;
        }
        Json deck = job.deck;
        if (made(deck)) {
            const std::string name = specimen_key(deck["specimen"]) + ".h5";
            const fs::path file = out_ / "specimens" / name;
            if (!fs::exists(file)) {
                make_specimen(deck, file);
            }
            if (fs::exists(file)) {
                const Json seed = deck["specimen"].value("seed", Json(SpecimenRecipe{}.seed));
                deck["specimen"] = {{"file", "../../../specimens/" + name}, {"seed", seed}}; // which strengths may be scattered by
            }
        }
        look();
        make_folder(folder / job.name);
        report::write_json((folder / job.name / "deck.json").string(), deck);
        list.push_back({{"job", job.name}, {"test", job.test}});
    }
    report::write_json((folder / "trial.json").string(),
                       {{"proveta_trial", 1}, {"physics", physics_revision()}, {"values", t.values}, {"jobs", list}});
    return true;
}

std::vector<std::string> jobs_of(const fs::path& trial) {
    const Json json = input::load_json((trial / "trial.json").string());
    if (!json.is_object() || !json.contains("proveta_trial")) {
        throw input::InputError({{(trial / "trial.json").string(), "", "another file", "the trial.json of a planned trial", ""}});
    }
    std::vector<std::string> out;
    for (const auto& job : json["jobs"]) {
        out.push_back(job["job"]);
    }
    return out;
}

void refuse_other_physics(const fs::path& trial) {
    const std::string file = (trial / "trial.json").string();
    if (const std::string planned = input::text_at(input::load_json(file), "physics"); planned != physics_revision()) {
        throw input::InputError(
            {{file, "/physics", "\"" + planned + "\"", fmt::format("\"{}\", this program's physics revision", physics_revision()),
              "carry it out by the program that planned it, or plan it again by this one"}});
    }
}

bool has_all_of(const JobResult& result, const fs::path& job) { return result.status != "complete" || fs::exists(job / "curve.csv"); }

std::optional<JobResult> result_in(const fs::path& job) {
    std::ifstream in(job / "result.json");
    const Json json = in ? Json::parse(in, nullptr, false) : Json();
    if (!json.is_object()) {
        return std::nullopt;
    }
    try {
        const JobResult result = job_result(json);
        return result.physics == physics_revision() && has_all_of(result, job) ? std::optional(result) : std::nullopt;
    } catch (const Json::exception&) {
        return std::nullopt; // of another kind
    }
}

std::vector<JobResult> TrialFolders::finished(const std::string& key) const {
    std::vector<JobResult> out;
    if (!fs::exists(trial(key) / "trial.json")) {
        return out;
    }
    for (const auto& name : jobs_of(trial(key))) {
        if (auto result = result_in(trial(key) / name)) {
            out.push_back(std::move(*result));
        }
    }
    return out;
}

namespace {

JobResult unfinished(const fs::path& folder) {
    JobResult result;
    result.name = folder.filename().string();
    result.physics = physics_revision();
    const Json trial = input::load_json((folder.parent_path() / "trial.json").string());
    for (const auto& job : trial["jobs"]) {
        if (job["job"] == result.name) {
            result.test = job["test"];
        }
    }
    return result;
}

} // namespace

void write_failure(const fs::path& folder, const std::string& reason, bool of_machine) {
    JobResult result = unfinished(folder);
    result.status = "failed";
    result.reason = reason;
    result.of_machine = of_machine;
    report::write_json((folder / "result.json").string(), to_json(result));
}

bool run_job(const fs::path& folder) {
    JobResult result = unfinished(folder);
    const auto start = std::chrono::steady_clock::now();
    try {
        run(folder, result);
    } catch (const FileError&) {
        throw; // of the machine and not of the test, which can be done again
    } catch (const std::bad_alloc&) {
        result.status = "failed";
        result.reason = "not enough memory";
        result.of_machine = true;
    } catch (const std::exception& e) {
        result.status = "failed";
        result.reason = e.what();
    }
    if (result.status == "interrupted") {
        return false;
    }
    result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    report::write_json((folder / "result.json").string(), to_json(result));
    return true;
}

report::Table job_curve(const fs::path& job) {
    report::Table table = read_csv((job / "curve.csv").string());
    // Headings are names with units (`report::Column::heading`).
    for (auto& column : table.columns) {
        for (const char* unit : {"Pa", "N", "s", "m/s"}) {
            const std::string ending = std::string("_") + unit;
            if (column.unit.empty() && column.name.ends_with(ending)) {
                column.unit = unit;
                column.name.resize(column.name.size() - ending.size());
            }
        }
    }
    return table;
}

} // namespace proveta

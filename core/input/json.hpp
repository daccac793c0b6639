// JSON as a source and a form of declared parameters.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/input/declare.hpp"
#include "core/input/describe.hpp"

// Compiled once (json_compiled.cpp) and not in each of the many files that see it, of whose time it takes a fifth.
extern template class nlohmann::basic_json<nlohmann::ordered_map>;

namespace proveta::input {

using Json = nlohmann::ordered_json;

/// One thing wrong with the user's input.
struct Problem {
    std::string source; ///< file
    std::string path;   ///< JSON pointer, "" for the whole file
    std::string found;
    std::string expected;   ///< empty: `found` says it all
    std::string suggestion; ///< may be empty

    [[nodiscard]] std::string text() const;
};

using Problems = std::vector<Problem>;

/// The user's input is wrong. Carries everything that is.
struct InputError : std::runtime_error {
    explicit InputError(Problems list);
    Problems problems;
};

/// Parses a file. Throws InputError when it is missing, unreadable, empty, too large or not JSON; the message names line and column.
Json load_json(const std::string& file);

/// Parses a text of at most 64 levels of objects and lists, of which no object has a key twice. Throws InputError; source is what it is
/// called there.
Json parse_json(const std::string& text, const std::string& source);

/// The text that an object has under a key; empty when it has none, or when it is no object.
std::string text_at(const Json& json, const char* key);

/// Sets `value` from the JSON object `json` and appends everything wrong with it to `problems`: wrong types, units, values out of bounds,
/// unknown keys. Keys that are absent keep their value. path is the object's own JSON pointer.
template <class T> void read(const Json& json, T& value, const std::string& source, const std::string& path, Problems& problems);

/// The values of a struct as JSON, SI units. Reading it back gives the same struct.
template <class T> Json write(const T& value);

/// JSON schema (draft 2020-12) of the object that `read` accepts.
template <class T> Json schema(const T& defaults);

// What the templates above are made of.

class JsonReader : public Visitor {
  public:
    JsonReader(const Json& json, std::string source, std::string path, Problems& problems);
    void finish(); ///< reports unknown keys of the outermost object
    [[nodiscard]] bool met_unknown_keys() const { return !unknown_.empty(); }
    /// Says of keys that were called unknown, and that some choice would have a use for, which choice there is; of those beside a choice
    /// that is none, nothing. all: what may be declared.
    void explain_unknown(const std::vector<ParameterInfo>& all);

    void number(const char*, double&, Unit, const Bounds&, const char*) override;
    void number_or_word(const char*, NumberOrWord&, const std::vector<Choice>&, Unit, const Bounds&, const char*) override;
    void integer(const char*, std::int64_t&, std::int64_t, std::int64_t, const char*) override;
    void text(const char*, std::string&, const char*) override;
    void choice(const char*, std::string&, const std::vector<Choice>&, const char*) override;
    void numbers(const char*, std::vector<double>&, std::size_t, Unit, const Bounds&, const char*) override;
    void refused(const char*, const char*) override;

  protected:
    bool begin_section(const char*, const char*) override;
    void end_section() override;
    std::optional<std::size_t> begin_list(const char*, std::size_t, const char*) override;
    void begin_item(std::size_t) override;
    void end_list() override;

  private:
    struct Frame {
        const Json* json;
        std::string path;
        std::vector<std::string> known;
        std::vector<std::string> chosen{}; // of the keys with a choice, such as "kind": "fixed"
        bool unsure = false;               // a choice is none of those there are: nobody knows which keys go with it
    };
    struct Unknown { // key, and the problem that it was made
        std::size_t problem;
        std::string key; // as ParameterInfo has it
        std::vector<std::string> chosen;
        bool unsure;
    };
    const Json* find(const char* key);
    void complain(const std::string& path, const std::string& found, const std::string& expected, const std::string& suggestion = "");
    bool to_number(const Json& j, const std::string& path, Unit unit, const Bounds& bounds, double& value);
    void report_unknown();

    std::vector<Frame> frames_;
    std::vector<Unknown> unknown_;
    std::string source_;
    Problems& problems_;
};

class JsonWriter : public Visitor {
  public:
    [[nodiscard]] Json take() { return std::move(stack_.back()); }

    void number(const char*, double&, Unit, const Bounds&, const char*) override;
    void number_or_word(const char*, NumberOrWord&, const std::vector<Choice>&, Unit, const Bounds&, const char*) override;
    void integer(const char*, std::int64_t&, std::int64_t, std::int64_t, const char*) override;
    void text(const char*, std::string&, const char*) override;
    void choice(const char*, std::string&, const std::vector<Choice>&, const char*) override;
    void numbers(const char*, std::vector<double>&, std::size_t, Unit, const Bounds&, const char*) override;
    void refused(const char*, const char*) override {}

  protected:
    bool begin_section(const char*, const char*) override;
    void end_section() override;
    std::optional<std::size_t> begin_list(const char*, std::size_t, const char*) override;
    void begin_item(std::size_t) override;
    void end_list() override;

  private:
    std::vector<Json> stack_{Json::object()};
    std::vector<std::string> names_;
};

class SchemaWriter : public Visitor {
  public:
    [[nodiscard]] Json take() { return std::move(stack_.back()); }

    void number(const char*, double&, Unit, const Bounds&, const char*) override;
    void number_or_word(const char*, NumberOrWord&, const std::vector<Choice>&, Unit, const Bounds&, const char*) override;
    void integer(const char*, std::int64_t&, std::int64_t, std::int64_t, const char*) override;
    void text(const char*, std::string&, const char*) override;
    void choice(const char*, std::string&, const std::vector<Choice>&, const char*) override;
    void numbers(const char*, std::vector<double>&, std::size_t, Unit, const Bounds&, const char*) override;
    void refused(const char*, const char*) override {}

  protected:
    bool begin_section(const char*, const char*) override;
    void end_section() override;
    std::optional<std::size_t> begin_list(const char*, std::size_t, const char*) override;
    void begin_item(std::size_t) override;
    void end_list() override;
    [[nodiscard]] bool reads_only_shape() const override { return true; }

  private:
    std::vector<Json> stack_{new_object()};
    std::vector<std::pair<std::string, std::string>> names_; // key and meaning of open sections
    static Json new_object();
};

template <class T> void read(const Json& json, T& value, const std::string& source, const std::string& path, Problems& problems) {
    JsonReader reader(json, source, path, problems);
    declare(reader, value);
    reader.finish();
    if (reader.met_unknown_keys()) {
        Describer all;
        declare(all, value); // which describing leaves as it is
        reader.explain_unknown(all.parameters());
    }
}

template <class T> Json write(const T& value) {
    JsonWriter writer;
    T copy = value;
    declare(writer, copy);
    return writer.take();
}

template <class T> Json schema(const T& defaults) {
    SchemaWriter writer;
    T copy = defaults;
    declare(writer, copy);
    return writer.take();
}

} // namespace proveta::input

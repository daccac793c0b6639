#include "core/input/json.hpp"

namespace proveta::input {

void JsonWriter::number(const char* key, double& value, Unit, const Bounds&, const char*) { stack_.back()[key] = value; }

void JsonWriter::number_or_word(const char* key, NumberOrWord& value, const std::vector<Choice>&, Unit, const Bounds&, const char*) {
    stack_.back()[key] = value.word.empty() ? Json(value.number) : Json(value.word);
}

void JsonWriter::integer(const char* key, std::int64_t& value, std::int64_t, std::int64_t, const char*) { stack_.back()[key] = value; }

void JsonWriter::text(const char* key, std::string& value, const char*) { stack_.back()[key] = value; }

void JsonWriter::choice(const char* key, std::string& value, const std::vector<Choice>&, const char*) { stack_.back()[key] = value; }

void JsonWriter::numbers(const char* key, std::vector<double>& values, std::size_t, Unit, const Bounds&, const char*) {
    stack_.back()[key] = values;
}

bool JsonWriter::begin_section(const char* key, const char*) {
    stack_.push_back(Json::object());
    names_.emplace_back(key);
    return true;
}

void JsonWriter::end_section() {
    Json done = std::move(stack_.back());
    stack_.pop_back();
    if (stack_.back().is_array()) {
        stack_.back().push_back(std::move(done));
    } else {
        stack_.back()[names_.back()] = std::move(done);
        names_.pop_back();
    }
}

std::optional<std::size_t> JsonWriter::begin_list(const char* key, std::size_t size, const char*) {
    stack_.push_back(Json::array());
    names_.emplace_back(key);
    return size;
}

void JsonWriter::begin_item(std::size_t) { stack_.push_back(Json::object()); }

void JsonWriter::end_list() {
    Json done = std::move(stack_.back());
    stack_.pop_back();
    stack_.back()[names_.back()] = std::move(done);
    names_.pop_back();
}

} // namespace proveta::input

#include "specimens/checkpoint.hpp"

#include <filesystem>

#include "core/files/whole_file.hpp"
#include "specimens/hdf5_file.hpp"

namespace proveta {

namespace {

constexpr const char* checkpoint_format = "proveta checkpoint 3";

// Stores what it is shown, or restores it.
template <class Go> class Visitor : public StateVisitor {
  public:
    explicit Visitor(Go go) : go_(go) {}

    void operator()(const std::string& name, double& value) override { go_(name, value); }
    void operator()(const std::string& name, std::int64_t& value) override { go_(name, value); }
    void operator()(const std::string& name, std::string& value) override { go_(name, value); }
    void operator()(const std::string& name, std::vector<double>& values) override { go_(name, values); }
    void operator()(const std::string& name, std::vector<std::int32_t>& values) override { go_(name, values); }
    void operator()(const std::string& name, std::vector<std::uint8_t>& values) override { go_(name, values); }

  private:
    Go go_;
};

} // namespace

std::string earlier_checkpoint(const std::string& file) {
    const std::filesystem::path path(file);
    return (path.parent_path() / (path.stem().string() + ".earlier" + path.extension().string())).string();
}

void save_checkpoint(const std::string& file, const std::string& owner, const VisitState& state) {
    const std::string next = file + ".next";
    Hdf5File h(next, Hdf5File::Mode::create);
    h.put_text("format", checkpoint_format);
    h.put_text("owner", owner);
    Visitor visitor([&](const std::string& name, const auto& value) { h.put(name, value); });
    state(visitor);
    h.close();
    std::error_code none_before;
    std::filesystem::rename(file, earlier_checkpoint(file), none_before);
    move_into_place(next, file); // who is killed just before it still has the earlier one
}

void load_checkpoint(const std::string& file, const std::string& owner, const VisitState& state) {
    try {
        const Hdf5File h(file, Hdf5File::Mode::read);
        if (!h.has("format") || h.get_text("format") != checkpoint_format) {
            throw CheckpointError(file + ": not a checkpoint of this program");
        }
        if (h.get_text("owner") != owner) {
            throw CheckpointError(file + ": belongs to another calculation");
        }
        Visitor visitor([&](const std::string& name, auto& value) { h.get(name, value); });
        state(visitor);
    } catch (const CheckpointError&) {
        throw;
    } catch (const std::runtime_error& e) {
        throw CheckpointError(e.what());
    }
}

} // namespace proveta

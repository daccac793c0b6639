// Every case of `proveta verify` as a test of its own; long ones carry the tag [.long] and run only when asked for.
#include <catch2/catch.hpp>

#include "lab/verification/table.hpp"

namespace {

using namespace proveta::verification;

class CaseTest : public Catch::ITestInvoker {
  public:
    explicit CaseTest(const Case& which) : which_(which) {}
    void invoke() const override {
        const Finished finished = run(which_);
        INFO(as_text({finished}));
        CHECK(finished.failure.empty());
        for (const auto& check : finished.outcome.checks) {
            INFO(check.quantity << ": expected " << check.expected << ", found " << check.found);
            CHECK(check.holds());
        }
    }

  private:
    const Case& which_;
};

const bool registered = [] {
    for (const auto& c : cases()) {
        const Catch::AutoReg test(new CaseTest(c), CATCH_INTERNAL_LINEINFO, "", {"verify: " + c.name, c.is_long ? "[.long]" : ""});
    }
    return true;
}();

} // namespace

TEST_CASE("verify: a check fails for a wrong value and for what is no number") {
    REQUIRE(registered);
    CHECK_FALSE(Check{"q", 1.0, 1.02, 0.01}.holds());
    CHECK(Check{"q", 1.0, 1.005, 0.01}.holds());
    CHECK_FALSE(Check{"q", 1.0, std::nan(""), 0.01}.holds());
    CHECK_FALSE(Check{"q", 0.1, 0.2, 0.0, Compare::at_most}.holds());
    const Case empty{"empty", "", "", false, [] { return Outcome{}; }};
    CHECK_FALSE(run(empty).holds());
    const Case throwing{"throws", "", "", false, []() -> Outcome { throw std::runtime_error("no"); }};
    CHECK(run(throwing).failure == "no");
}

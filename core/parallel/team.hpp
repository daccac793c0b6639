// A team of threads that works through the parts of a job, for loops of some ten microseconds.
//
// Every thread begins with its own share of the parts, the same in every job, so that their data stay in its cache; who is done helps the
// others. Which thread does a part never changes what the part computes. Waiting threads spin for a few microseconds and then sleep, so
// that a team costs a shared machine no more than the work it does.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <memory>
#include <thread>
#include <type_traits>
#include <vector>

namespace proveta {

class Team {
  public:
    /// threads: at least 1, the caller's among them.
    explicit Team(int threads);
    ~Team();
    Team(const Team&) = delete;
    Team& operator=(const Team&) = delete;

    [[nodiscard]] int threads() const { return static_cast<int>(workers_.size()) + 1; }

    static constexpr std::size_t most_parts = (1u << 20) - 1;

    /// Calls work(part) once for every part below `parts`, at most `most_parts`, and returns when all are done; throws what the first of
    /// them threw, if any did.
    template <class Work> void run(std::size_t parts, Work&& work) {
        using Plain = std::remove_reference_t<Work>;
        start(
            parts, [](void* object, std::size_t part) { (*static_cast<Plain*>(object))(part); },
            const_cast<void*>(static_cast<const void*>(&work)));
    }

  private:
    using Function = void (*)(void*, std::size_t);
    // What is left of a thread's share: number of the job, next part, end. One word, so that a part of a job that is over cannot be taken.
    struct alignas(64) Share {
        std::atomic<std::uint64_t> left{0};
    };

    void start(std::size_t parts, Function function, void* object);
    void work(std::size_t self);
    bool take(Share& share, std::size_t& part);
    void serve(std::size_t self);

    std::vector<Share> shares_;
    Function function_ = nullptr;
    void* object_ = nullptr;
    std::uint32_t parts_ = 0;
    alignas(64) std::atomic<std::uint32_t> job_{0};
    alignas(64) std::atomic<std::uint32_t> done_{0}; // parts done of this job
    std::atomic<bool> over_{false};
    std::atomic<bool> failed_{false};
    std::exception_ptr failure_; // of the first part that threw
    std::vector<std::thread> workers_;
};

} // namespace proveta

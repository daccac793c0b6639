#include "core/parallel/team.hpp"

#include <algorithm>
#include <utility>

namespace proveta {

namespace {

constexpr int part_bits = 20;
constexpr std::uint64_t part_mask = (std::uint64_t{1} << part_bits) - 1;
constexpr std::uint32_t job_mask = (std::uint32_t{1} << 24) - 1;

std::uint64_t pack(std::uint32_t job, std::uint64_t next, std::uint64_t end) {
    return (std::uint64_t{job & job_mask} << (2 * part_bits)) | (next << part_bits) | end;
}

void relax() {
#if defined(__x86_64__) || defined(__i386__)
    __builtin_ia32_pause();
#endif
}

// Waits until the value is no longer `old`: some microseconds awake, then asleep.
void wait_for_change(const std::atomic<std::uint32_t>& value, std::uint32_t old) {
    for (int k = 0; k < 500; ++k) {
        if (value.load(std::memory_order_acquire) != old) {
            return;
        }
        relax();
    }
    value.wait(old, std::memory_order_acquire);
}

} // namespace

Team::Team(int threads) : shares_(static_cast<std::size_t>(std::max(threads, 1))) {
    for (std::size_t k = 1; k < shares_.size(); ++k) {
        workers_.emplace_back([this, k] { serve(k); });
    }
}

Team::~Team() {
    over_.store(true);
    job_.fetch_add(1);
    job_.notify_all();
    for (auto& worker : workers_) {
        worker.join();
    }
}

void Team::start(std::size_t parts, Function function, void* object) {
    if (workers_.empty() || parts < 2) {
        for (std::size_t part = 0; part < parts; ++part) {
            function(object, part);
        }
        return;
    }
    function_ = function;
    object_ = object;
    parts_ = static_cast<std::uint32_t>(parts);
    done_.store(0, std::memory_order_relaxed);
    const std::uint32_t job = job_.load(std::memory_order_relaxed) + 1;
    const std::size_t n = shares_.size();
    for (std::size_t k = 0; k < n; ++k) {
        shares_[k].left.store(pack(job, k * parts / n, (k + 1) * parts / n), std::memory_order_release);
    }
    job_.store(job, std::memory_order_release);
    job_.notify_all();
    work(0);
    for (std::uint32_t seen = done_.load(std::memory_order_acquire); seen != parts_; seen = done_.load(std::memory_order_acquire)) {
        wait_for_change(done_, seen);
    }
    if (failed_.load()) {
        failed_.store(false);
        std::rethrow_exception(std::exchange(failure_, nullptr));
    }
}

bool Team::take(Share& share, std::size_t& part) {
    std::uint64_t left = share.left.load(std::memory_order_acquire);
    for (;;) {
        const std::uint64_t next = (left >> part_bits) & part_mask;
        if (next >= (left & part_mask)) {
            return false;
        }
        if (share.left.compare_exchange_weak(left, left + (std::uint64_t{1} << part_bits), std::memory_order_acq_rel,
                                             std::memory_order_acquire)) {
            part = next;
            return true;
        }
    }
}

void Team::work(std::size_t self) {
    std::uint32_t done = 0;
    std::size_t part = 0;
    for (std::size_t k = 0; k < shares_.size(); ++k) {
        while (take(shares_[(self + k) % shares_.size()], part)) {
            try {
                function_(object_, part); // a part that was taken keeps its job alive until it is counted below
            } catch (...) {
                if (!failed_.exchange(true)) {
                    failure_ = std::current_exception();
                }
            }
            ++done;
        }
    }
    if (done > 0) {
        done_.fetch_add(done, std::memory_order_acq_rel);
        if (self != 0) {
            done_.notify_one();
        }
    }
}

void Team::serve(std::size_t self) {
    std::uint32_t seen = 0;
    for (;;) {
        wait_for_change(job_, seen);
        seen = job_.load(std::memory_order_acquire);
        if (over_.load()) {
            return;
        }
        work(self);
    }
}

} // namespace proveta

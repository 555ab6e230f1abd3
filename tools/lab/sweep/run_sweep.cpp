#include "tools/lab/sweep/run_sweep.hpp"

#include <algorithm>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>

namespace aisle::lab {
namespace {

/// What came of one trial.
struct Finished {
  bool is_done{false};
  std::optional<Row> row;  // none: interrupted
  std::exception_ptr error;
};

/// Trials that are handed to threads in order, and handed back in order. One mutex guards all of it.
class Queue {
 public:
  Queue(std::vector<const Trial*> trials, const RunTrial& run, const SweepRun& how)
      : trials_(std::move(trials)), finished_(trials_.size()), run_(run), how_(how) {
    for (int i = 0; i < std::max(1, how.workers); ++i) threads_.emplace_back([this] { work(); });
  }

  ~Queue() {
    stop();
    for (std::thread& thread : threads_) thread.join();
  }
  Queue(const Queue&) = delete;
  Queue& operator=(const Queue&) = delete;

  /// Waits for the trial's end.
  Finished take(std::size_t i) {
    std::unique_lock<std::mutex> guard(mutex_);
    changed_.wait(guard, [&] { return finished_[i].is_done; });
    return std::move(finished_[i]);
  }

  void stop() {
    const std::lock_guard<std::mutex> guard(mutex_);
    is_stopped_ = true;
  }

 private:
  bool is_interrupted() {
    const std::lock_guard<std::mutex> guard(mutex_);
    return is_stopped_ || how_.is_interrupted();
  }

  /// A thread's life: the next trial, until there is none.
  void work() {
    for (;;) {
      std::size_t i = 0;
      {
        const std::lock_guard<std::mutex> guard(mutex_);
        if (next_ == trials_.size()) return;
        i = next_++;
      }

      Finished finished = run(*trials_[i]);
      finished.is_done = true;
      {
        const std::lock_guard<std::mutex> guard(mutex_);
        finished_[i] = std::move(finished);
      }
      changed_.notify_all();
    }
  }

  /// Once it is interrupted, the trials that are left end at once.
  Finished run(const Trial& trial) {
    Finished finished;
    try {
      if (!is_interrupted()) finished.row = run_(trial, [this] { return is_interrupted(); });
    } catch (...) {
      finished.error = std::current_exception();
    }
    return finished;
  }

  std::vector<const Trial*> trials_;
  std::vector<Finished> finished_;
  const RunTrial& run_;
  const SweepRun& how_;
  std::size_t next_{0};
  bool is_stopped_{false};
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<std::thread> threads_;
};

}  // namespace

std::vector<Row> run_sweep(const std::vector<Trial>& trials, const std::map<std::size_t, Row>& kept,
                           const RunTrial& run, const SweepRun& how) {
  std::vector<const Trial*> missing;
  for (const Trial& trial : trials)
    if (kept.count(trial.index) == 0) missing.push_back(&trial);

  std::map<std::size_t, Row> rows = kept;
  Queue queue(missing, run, how);

  for (std::size_t i = 0; i < missing.size(); ++i) {
    Finished finished = queue.take(i);
    if (finished.error) std::rethrow_exception(finished.error);
    if (!finished.row) break;

    how.take(*finished.row);
    rows[missing[i]->index] = std::move(*finished.row);
    if (how.tell) how.tell(rows.size(), trials.size());
  }

  std::vector<Row> in_order;
  for (auto& [index, row] : rows) in_order.push_back(std::move(row));
  return in_order;
}

}  // namespace aisle::lab

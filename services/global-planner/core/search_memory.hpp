#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <memory>
#include <new>
#include <vector>

namespace aisle::global_planner {

/// Costs are integers, so that equal paths cost exactly the same: 3363/2378 is the square root of 2 to 6e-8.
inline constexpr std::uint32_t kStraightCost = 2378;
inline constexpr std::uint32_t kDiagonalCost = 3363;

/// What a search knows of each cell, in 8 bytes: its cost so far, the step that led there, and whether it is closed.
/// Kept between searches: a generation number tells old entries from new ones, so that beginning a search costs
/// nothing, however large the map. Pages of cells that no search came to are never touched, and take no memory where
/// the operating system gives it out page by page.
class SearchNodes {
 public:
  /// Forgets all nodes. `cells`: of the map. @throws std::bad_alloc
  void begin(std::size_t cells) {
    if (size_ != cells || generation_ == kLastGeneration) {
      release();
      nodes_.reset(static_cast<Node*>(std::calloc(cells, sizeof(Node))));  // large blocks come untouched, and zero
      if (!nodes_) throw std::bad_alloc();
      size_ = cells;
    }

    ++generation_;
  }

  /// Gives the memory back, until the next begin().
  void release() {
    nodes_.reset();
    size_ = 0;
    generation_ = 0;
  }

  /// Was the cell reached in this search?
  bool is_known(std::size_t index) const { return nodes_[index].mark >> kShift == generation_; }

  /// @pre is_known(index)
  bool is_closed(std::size_t index) const { return (nodes_[index].mark & kClosed) != 0; }
  std::uint32_t cost(std::size_t index) const { return nodes_[index].cost; }

  /// The cost, or the greatest number when the cell is not known.
  std::uint32_t known_cost(std::size_t index) const {
    const Node& node = nodes_[index];
    return node.mark >> kShift == generation_ ? node.cost : std::numeric_limits<std::uint32_t>::max();
  }

  /// The step of kSteps that led here. @pre is_known(index)
  int direction(std::size_t index) const { return static_cast<int>(nodes_[index].mark & kDirection); }

  /// Opens the cell, or gives an open one a better cost. It is not closed afterwards.
  void reach(std::size_t index, std::uint32_t cost, int direction) {
    nodes_[index] = {cost, (generation_ << kShift) | static_cast<std::uint32_t>(direction)};
  }

  /// The cell was expanded. @pre is_known(index)
  void close(std::size_t index) { nodes_[index].mark |= kClosed; }

 private:
  static constexpr std::uint32_t kDirection = 7;  // the step that led here, see kSteps

  static constexpr std::uint32_t kClosed = 8;
  static constexpr int kShift = 4;
  static constexpr std::uint32_t kLastGeneration = std::numeric_limits<std::uint32_t>::max() >> kShift;

  struct Node {
    std::uint32_t cost;
    std::uint32_t mark;
  };

  struct Free {
    void operator()(Node* nodes) const { std::free(nodes); }
  };

  std::unique_ptr<Node[], Free> nodes_;
  std::size_t size_{0};
  std::uint32_t generation_{0};
};

/// Open cells in buckets of equal rank, last in first out within a bucket: pushing and popping take constant time
/// (Dial 1969). A rank is an evaluation divided by the width of a bucket, so that within a bucket the order is
/// approximate. Ranks may go below the current one, as they do with inconsistent heuristics.
class BucketQueue {
 public:
  /// `cost`: of the cell when it was pushed; the entry is stale when the cell has a lower one by now.
  struct Entry {
    std::uint32_t cell;
    std::uint32_t cost;
    std::uint32_t next;
  };

  static constexpr int kWidthShift = 7;  // 128 cost units a bucket: 0.054 of a straight step
  static std::uint32_t rank_of(std::uint32_t evaluation) { return evaluation >> kWidthShift; }

  /// Gives the memory back.
  void release() { *this = BucketQueue(); }

  /// Empties the queue; only buckets that were used are cleared.
  void begin() {
    if (low_ <= high_ && !heads_.empty()) std::fill(heads_.begin() + low_, heads_.begin() + high_ + 1, kNone);
    pool_.clear();
    free_ = kNone;
    low_ = std::numeric_limits<std::uint32_t>::max();
    high_ = 0;
    current_ = 0;
  }

  /// Adds an entry. Places of popped entries are used again.
  void push(std::uint32_t evaluation, std::uint32_t cell, std::uint32_t cost) {
    const std::uint32_t rank = rank_of(evaluation);
    if (rank >= heads_.size())
      heads_.resize(std::max<std::size_t>(rank + 1U, heads_.size() + heads_.size() / 2), kNone);

    low_ = std::min(low_, rank);
    high_ = std::max(high_, rank);
    current_ = std::min(current_, rank);

    std::uint32_t slot = free_;
    if (slot == kNone) {
      slot = static_cast<std::uint32_t>(pool_.size());
      pool_.push_back({cell, cost, heads_[rank]});
    } else {
      free_ = pool_[slot].next;
      pool_[slot] = {cell, cost, heads_[rank]};
    }

    heads_[rank] = slot;
  }

  /// Takes an entry of the lowest rank; false when nothing is left. rank() is that of the popped entry.
  bool pop(Entry& entry) {
    if (low_ > high_) return false;
    while (current_ <= high_ && heads_[current_] == kNone) ++current_;
    if (current_ > high_) return false;

    const std::uint32_t slot = heads_[current_];
    entry = pool_[slot];
    heads_[current_] = entry.next;

    pool_[slot].next = free_;
    free_ = slot;

    return true;
  }

  /// Rank of the entry popped last.
  std::uint32_t rank() const { return current_; }

 private:
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  std::vector<std::uint32_t> heads_;  // first entry of each bucket
  std::vector<Entry> pool_;           // all entries, linked by `next`
  std::uint32_t free_{kNone};         // first of the unused ones
  std::uint32_t low_{kNone};          // the buckets that were used
  std::uint32_t high_{0};
  std::uint32_t current_{0};  // no entry lies below it
};

}  // namespace aisle::global_planner

#include "common/bus/simulated/links.hpp"

#include <algorithm>

namespace aisle::bus::simulated {
namespace {

constexpr time::Stamp kLeastLatency{1000};

}  // namespace

int Links::host(const std::string& name) {
  const auto found = std::find(hosts_.begin(), hosts_.end(), name);
  if (found != hosts_.end()) return static_cast<int>(found - hosts_.begin());
  hosts_.push_back(name);
  return static_cast<int>(hosts_.size()) - 1;
}

const Link& Links::link(int from, int to) const {
  const auto found = own_.find({from, to});
  if (found != own_.end()) return found->second;
  return from == to ? base_ : between_;
}

/// Remembers since when nothing passes: leases run from then.
void Links::set_link(int from, int to, const Link& link, time::Stamp now) {
  const bool was_cut = this->link(from, to).passes_nothing();
  if (link.passes_nothing() && !was_cut) cut_since_[{from, to}] = now;
  if (link.passes_nothing() && was_cut) cut_since_.try_emplace({from, to}, all_cut_since_);
  own_[{from, to}] = link;
}

void Links::set_all_between(const Link& link, time::Stamp now) {
  for (auto entry = own_.begin(); entry != own_.end();) {
    entry = entry->first.first == entry->first.second ? std::next(entry) : own_.erase(entry);
  }

  if (link.passes_nothing() && !between_.passes_nothing()) all_cut_since_ = now;
  between_ = link;
}

std::optional<time::Stamp> Links::cut_since(int from, int to) const {
  if (!link(from, to).passes_nothing()) return std::nullopt;
  const auto found = own_.count({from, to}) > 0 ? cut_since_.find({from, to}) : cut_since_.end();
  return found != cut_since_.end() ? found->second : all_cut_since_;
}

/// In [0, 1), the same on every machine (the library's distributions need not be).
double Links::chance() { return static_cast<double>(random_() >> 11) * 0x1.0p-53; }

time::Stamp Links::delay(const Link& link) {
  time::Stamp delay = std::max(kLeastLatency, link.latency);
  if (link.jitter.count() > 0) {
    delay += time::Stamp(random_() % (static_cast<std::uint64_t>(link.jitter.count()) + 1));
  }

  return delay;
}

/// A number is drawn only for what the link can do, in a fixed order: so a link without faults draws
/// nothing.
Links::Fate Links::send(int from, int to) {
  const Link& link = this->link(from, to);
  ++tally_.sent;

  if (link.cut) {
    ++tally_.cut;
    return {};
  }

  if (link.loss > 0.0 && chance() < link.loss) {
    ++tally_.lost;
    return {};
  }

  // It arrives: when, and how often.
  Fate fate;
  fate.copies = 1;
  fate.after[0] = delay(link);

  if (link.reorder > 0.0 && chance() < link.reorder) {
    ++tally_.reordered;
    fate.after[0] += link.hold_back;
  }

  if (link.duplicate > 0.0 && chance() < link.duplicate) {
    ++tally_.duplicated;
    fate.copies = 2;
    fate.after[1] = delay(link);
  }

  if (fate.after[0] > base_.latency + base_.jitter) ++tally_.delayed;
  return fate;
}

}  // namespace aisle::bus::simulated

// Timetable: who goes first where two ways meet, and the forecasts that follow from it.

#include <algorithm>

#include "services/global-planner/core/traffic/timetable.hpp"

namespace aisle::global_planner::traffic {
namespace {

using Use = Reservation::Use;

// A vehicle that is later than its forecast is forecast to be done so soon.
constexpr double kLateStepS = 0.2;

// Forecasts that differ by less are equal.
constexpr double kSameForecastS = 1e-6;

}  // namespace

bool Timetable::is_before(const Agent& a, std::size_t a_index, const Agent& b, std::size_t b_index) const {
  const bool a_is_granted = a_index < a.pending();
  const bool b_is_granted = b_index < b.pending();
  if (a_is_granted != b_is_granted) return a_is_granted;

  const double a_s = a.steps[a_index].begin_s;
  const double b_s = b.steps[b_index].begin_s;
  return a_s != b_s ? a_s < b_s : a.number < b.number;
}

bool Timetable::enters(const Step& step, std::uint32_t corridor) const {
  const Motion& motion = roadmap_.motion(step.motion);
  return roadmap_.place(motion.to).corridor == corridor && roadmap_.place(motion.from).corridor != corridor;
}

/// Does the step begin after the other vehicle has come to rest? @pre it meets that vehicle's rest, or its corridor
bool Timetable::is_after_rest(const Agent& agent, std::size_t index, const Agent& rester) const {
  if (index < agent.pending()) return false;
  return rester.pending() == rester.steps.size() ||
         rester.steps.back().end_s <= agent.steps[index].begin_s + kSameForecastS;
}

/// Links the step to another vehicle's, unless an earlier one of its own vehicle waits for that already.
void Timetable::add_link(Agent& agent, std::size_t index, const Agent& to, std::uint64_t number) {
  for (std::size_t i = agent.pending(); i < index; ++i)
    for (const Link& link : agent.steps[i].links)
      if (link.agent == to.number && link.step >= number) return;

  auto& links = agent.steps[index].links;
  const auto place = std::lower_bound(links.begin(), links.end(), to.number,
                                      [](const Link& link, std::uint32_t number_of) { return link.agent < number_of; });
  if (place != links.end() && place->agent == to.number)
    place->step = std::max(place->step, number);
  else
    links.insert(place, {to.id, number, to.number});
}

/// No step of others is linked to the agent's any more, and none of its own to others.
void Timetable::unlink(const Agent& agent) {
  for (auto& [id, other] : agents_) {
    for (std::size_t i = other.pending(); i < other.steps.size(); ++i) {
      auto& links = other.steps[i].links;
      if (other.number == agent.number)
        links.clear();
      else
        links.erase(
            std::remove_if(links.begin(), links.end(), [&](const Link& link) { return link.agent == agent.number; }),
            links.end());
    }
  }
}

/// Links between the agent's step and those of others that meet this part of its shape.
void Timetable::link_shape(Agent& agent, std::size_t index, ShapeId shape) {
  const bool is_granted = index < agent.pending();
  reservations_.visit_meeting(shape, [&](const Reservation& met) {
    if (met.agent == agent.number) return;
    Agent& other = *by_number_[met.agent];

    if (met.use == Use::kRest) {
      if (is_after_rest(agent, index, other)) add_link(agent, index, other, other.beyond());
    } else if (met.use == Use::kStep) {
      const std::size_t other_index = static_cast<std::size_t>(met.step - other.done);
      const bool is_other_granted = other_index < other.pending();
      if (is_before(other, other_index, agent, index)) {
        if (!is_granted) add_link(agent, index, other, met.step);
      } else if (!is_other_granted) {
        add_link(other, other_index, agent, agent.done + index);
      }
    }
  });
}

/// A step that enters a corridor waits for those who rest in it.
void Timetable::link_corridor(Agent& agent, std::size_t index) {
  const std::uint32_t corridor = roadmap_.place(roadmap_.motion(agent.steps[index].motion).to).corridor;
  if (corridor == kNoId || !enters(agent.steps[index], corridor)) return;

  const auto rests = corridor_rests_.find(corridor);
  if (rests == corridor_rests_.end()) return;

  for (const ReservationId id : rests->second) {
    const Agent& other = *by_number_[reservations_[id].agent];
    if (other.number != agent.number && is_after_rest(agent, index, other))
      add_link(agent, index, other, other.beyond());
  }
}

/// Steps of others that pass where the agent rests, or enter the corridor in which it rests.
void Timetable::link_those_over_rest(const Agent& agent) {
  const Book& book = books_[agent.number];
  reservations_.visit_meeting(reservations_[book.rest].shape, [&](const Reservation& met) {
    if (met.agent == agent.number || met.use != Use::kStep) return;
    Agent& other = *by_number_[met.agent];
    const std::size_t index = static_cast<std::size_t>(met.step - other.done);
    if (is_after_rest(other, index, agent)) add_link(other, index, agent, agent.beyond());
  });

  if (book.corridor == kNoId) return;
  for (auto& [id, other] : agents_) {
    if (other.number == agent.number) continue;
    for (std::size_t i = other.pending(); i < other.steps.size(); ++i)
      if (enters(other.steps[i], book.corridor) && is_after_rest(other, i, agent))
        add_link(other, i, agent, agent.beyond());
  }
}

/// All links between the agent's steps and those of others. @pre none of them is linked yet
void Timetable::relink(Agent& agent) {
  const Book& book = books_[agent.number];
  for (std::size_t i = 0; i < agent.steps.size(); ++i) {
    link_shape(agent, i, reservations_[book.steps[i].motion].shape);
    if (book.steps[i].corner != kNoId) link_shape(agent, i, reservations_[book.steps[i].corner].shape);
    if (i >= agent.pending()) link_corridor(agent, i);
  }
  link_those_over_rest(agent);
}

std::set<std::uint32_t> Timetable::asked_to_leave() const {
  std::set<std::uint32_t> out;
  for (const auto& [id, agent] : agents_) {
    for (std::size_t i = agent.pending(); i < agent.steps.size(); ++i) {
      for (const Link& link : agent.steps[i].links) {
        const Agent* other = by_number_[link.agent];
        if (other != nullptr && link.step >= other->beyond()) out.insert(other->number);
      }
    }
  }
  return out;
}

std::vector<std::string> Timetable::those_met(const Agent& agent, const std::vector<Leg>& legs) {
  std::vector<std::string> out;
  for (const Leg& leg : legs) {
    reservations_.visit_meeting(meetings_.of_motion(leg.motion), [&](const Reservation& met) {
      if (met.agent == agent.number) return;
      const bool is_at_that_time = met.from_s < leg.end_s && leg.begin_s < met.to_s;
      const std::string& id = by_number_[met.agent]->id;
      if ((is_at_that_time || met.use == Use::kRest) && std::find(out.begin(), out.end(), id) == out.end())
        out.push_back(id);
    });
  }
  return out;
}

/// All steps, and which of them must end before which others begin.
///
/// How: a step waits for the one before it and for those that it is linked to. What is linked to a step that has no
/// plan yet waits `soft_rest_s` from when that vehicle comes to rest.
Timetable::StepGraph Timetable::graph_of_steps(double now_s) {
  StepGraph graph;
  std::vector<std::uint32_t> first(by_number_.size(), 0);  // node of each vehicle's first step
  for (auto& [id, agent] : agents_) {
    first[agent.number] = static_cast<std::uint32_t>(graph.nodes.size());
    for (std::size_t i = 0; i < agent.steps.size(); ++i)
      graph.nodes.push_back({&agent.steps[i], i == 0 && agent.pending() > 0, now_s, 0});
  }

  for (const auto& [id, agent] : agents_) {
    for (std::size_t i = 0; i < agent.steps.size(); ++i) {
      const std::uint32_t node = first[agent.number] + static_cast<std::uint32_t>(i);
      if (i > 0) graph.edges.push_back({node - 1, node, 0.0});
      if (i < agent.pending()) continue;

      for (const Link& link : agent.steps[i].links) {
        if (is_done(link)) continue;
        const Agent& other = *by_number_[link.agent];
        const bool has_plan = link.step < other.beyond();
        const std::size_t index = has_plan ? static_cast<std::size_t>(link.step - other.done) : other.steps.size() - 1;
        const double delay_s = has_plan ? 0.0 : soft_rest_s_;
        if (other.steps.empty())
          graph.nodes[node].ready_s = std::max(graph.nodes[node].ready_s, now_s + delay_s);
        else
          graph.edges.push_back({first[other.number] + static_cast<std::uint32_t>(index), node, delay_s});
      }
    }
  }

  std::stable_sort(graph.edges.begin(), graph.edges.end(),
                   [](const auto& a, const auto& b) { return a.from < b.from; });
  for (const auto& edge : graph.edges) ++graph.nodes[edge.to].waits_for;
  return graph;
}

bool Timetable::retime(double now_s) {
  reservations_.tidy_up();
  StepGraph graph = graph_of_steps(now_s);
  std::vector<std::uint32_t> known;  // nodes whose begin is known
  for (std::uint32_t node = 0; node < graph.nodes.size(); ++node)
    if (graph.nodes[node].waits_for == 0) known.push_back(node);

  for (std::size_t next = 0; next < known.size(); ++next) {
    const StepGraph::Node& node = graph.nodes[known[next]];
    Step& step = *node.step;
    const double run_s = step.end_s - step.begin_s;
    step.begin_s = node.is_driven ? std::min(step.begin_s, now_s) : node.ready_s;
    step.end_s = node.is_driven ? std::max(step.begin_s + run_s, now_s + kLateStepS) : step.begin_s + run_s;

    const auto from_node = [](const StepGraph::Edge& edge, std::uint32_t from) { return edge.from < from; };
    auto edge = std::lower_bound(graph.edges.begin(), graph.edges.end(), known[next], from_node);
    for (; edge != graph.edges.end() && edge->from == known[next]; ++edge) {
      StepGraph::Node& after = graph.nodes[edge->to];
      after.ready_s = std::max(after.ready_s, step.end_s + edge->delay_s);
      if (--after.waits_for == 0) known.push_back(edge->to);
    }
  }

  for (const auto& [id, agent] : agents_) write_times(agent);
  return known.size() == graph.nodes.size();
}

}  // namespace aisle::global_planner::traffic

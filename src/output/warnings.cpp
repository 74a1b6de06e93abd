#include "output/warnings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "output/numerical_warnings.hpp"

namespace nsframe {

namespace {

using Sentences = std::vector<std::string>;

void of_the_scheme(const Model&, const Summary& summary, Sentences& out) {
  for (std::string& sentence : numerical_warnings(summary)) out.push_back(std::move(sentence));
}

// Share of its slab's mass that a corner owns; 1 for a node that is no corner of a flexible slab.
double share_of_slab(const Model& model, int node) {
  for (const Slab& slab : model.slabs) {
    if (slab.rigid || std::find(slab.corners.begin(), slab.corners.end(), node) == slab.corners.end()) continue;
    double whole = slab.center >= 0 ? model.nodal_mass[6 * slab.center] : 0;
    for (const int corner : slab.corners) whole += corner >= 0 ? model.nodal_mass[6 * corner] : 0;
    if (whole > 0) return model.nodal_mass[6 * node] / whole;
  }
  return 1;
}

void of_light_contact_nodes(const Model& model, const Summary& summary, Sentences& out) {
  const auto& pairs = model.contacts.pairs;
  if (summary.poundings.empty()) return;
  double share = 1, least = 1e300, most = -1e300;
  for (const Pounding& pounding : summary.poundings) {
    const ContactPair& pair = pairs[static_cast<std::size_t>(pounding.pair)];
    if (pair.rigid_bodies) continue;
    for (const ContactPoint* point : {&pair.a, &pair.b}) {
      for (const PointShare& part : point->shares) share = std::min(share, share_of_slab(model, part.node));
    }
    least = std::min(least, pounding.effective_restitution);
    most = std::max(most, pounding.effective_restitution);
  }
  if (least > most) return;
  const std::string came_out = most - least < 0.005 ? fmt::format("as {:.2f}", least)
                                                    : fmt::format("between {:.2f} and {:.2f}", least, most);
  out.push_back(fmt::format("the restitution acts on points of flexible slabs or of columns, each with its share of the mass{}: "
                            "that of the poundings came out {}; rigid slabs against each other would have that of the scene",
                            share < 1 ? fmt::format(" (down to {:.0f} % of a slab)", 100 * share) : "", came_out));
}

constexpr double restitution_tolerance = 0.05;
constexpr double weak_pounding = 0.01;  // of the fastest approach: at slower ones ratios of velocities say nothing

// Of pairs of rigid bodies, where Newton's e would be that of a single impact.
void of_effective_restitution(const Model& model, const Summary& summary, Sentences& out) {
  int seen = 0, different = 0;
  const Pounding* worst = nullptr;
  const auto departure = [&](const Pounding& p) {
    return std::abs(p.effective_restitution - model.contacts.restitution[p.pair]);
  };
  double fastest = 0;
  for (const Pounding& pounding : summary.poundings) fastest = std::max(fastest, pounding.approach_velocity);
  for (const Pounding& pounding : summary.poundings) {
    const ContactPair& pair = model.contacts.pairs[static_cast<std::size_t>(pounding.pair)];
    if (!pair.rigid_bodies || !(pounding.approach_velocity > weak_pounding * fastest)) continue;
    ++seen;
    if (departure(pounding) <= restitution_tolerance) continue;
    ++different;
    if (!worst || departure(pounding) > departure(*worst) + 1e-6) worst = &pounding;  // the first of those that rounding alone orders
  }
  if (!worst) return;
  out.push_back(fmt::format("{} of {} pounding{} did not part with the restitution of the scene: at t = {:.4g} s, {} parted with "
                            "{:.2f} in place of {:.2f}, over {} impact{}",
                            different, seen, seen == 1 ? "" : "s", worst->time,
                            model.contacts.pairs[static_cast<std::size_t>(worst->pair)].name,
                            std::abs(worst->effective_restitution) < 0.005 ? 0.0 : worst->effective_restitution,  // not -0.00
                            model.contacts.restitution[worst->pair], worst->impacts, worst->impacts == 1 ? "" : "s"));
}

constexpr double deep = 0.05;  // of the smallest gap

void of_penetration(const Model& model, const Summary& summary, Sentences& out) {
  double gap = 1e300;
  for (const double open : model.contacts.initial_gap) gap = open > 0 ? std::min(gap, open) : gap;
  if (!(summary.max_penetration > deep * gap)) return;
  const auto& pairs = model.contacts.pairs;
  const bool any_force = std::any_of(pairs.begin(), pairs.end(), [](const ContactPair& pair) { return pair.law.is_force(); });
  out.push_back(fmt::format("the largest penetration, {:.3g} mm, is {:.0f} % of the smallest gap, {:.3g} mm: a {} lessens it",
                            1e3 * summary.max_penetration, 100 * summary.max_penetration / gap, 1e3 * gap,
                            any_force ? "stiffer law of contact" : "smaller dt"));
}

constexpr double resolved = 10;  // steps

// A contact with a law of force that the steps do not follow parts with a restitution of the scheme's own.
void of_short_contacts(const Model& model, const Summary& summary, Sentences& out) {
  long contacts = 0, brief = 0;
  const Impact* shortest = nullptr;
  for (const Impact& impact : summary.impacts) {
    if (!model.contacts.pairs[static_cast<std::size_t>(impact.pair)].law.is_force()) continue;
    ++contacts;
    if (impact.duration >= resolved * summary.dt) continue;
    ++brief;
    if (!shortest || impact.duration < shortest->duration) shortest = &impact;
  }
  if (!shortest) return;
  const ContactPair& pair = model.contacts.pairs[static_cast<std::size_t>(shortest->pair)];
  out.push_back(fmt::format("{} of {} contact{} with penalty laws lasted less than {:g} steps, the shortest {:.1f} ({}, {}): steps, and not the "
                            "law, rule how they part; take a smaller dt, or a softer law",
                            brief, contacts, contacts == 1 ? "" : "s", resolved, shortest->duration / summary.dt, pair.name, pair.law.name));
}

// A straight line between samples `dt` apart keeps sinc(f dt)^2 of a wave of frequency f (the transform of a triangle).
double kept_between_samples(double f, double dt) {
  const double x = std::acos(-1.0) * f * dt;
  return x > 0 ? std::pow(std::sin(x) / x, 2) : 1;
}

void of_coarse_motions(const Model& model, const Summary& summary, Sentences& out) {
  std::set<std::string> said;  // of records that move supports one after the other, once
  for (const GroundMotion& motion : model.motions) {
    if (!said.insert(motion.source).second && motion.of_supports) continue;
    if (summary.scheme == "moreau-jean" && summary.dt > motion.dt * (1 + 1e-9)) {
      out.push_back(fmt::format("dt = {:g} ms steps over samples of the ground motion, which are {:g} ms apart", 1e3 * summary.dt,
                                1e3 * motion.dt));
    }
    const ModeNumerics* fastest = nullptr;
    for (const ModeNumerics& mode : summary.modes) {
      const double shaken = mode.shares.dot(motion.direction.cwiseAbs2());
      if (shaken >= 0.05 && (!fastest || mode.frequency > fastest->frequency) && mode.frequency * motion.dt < 1 &&
          kept_between_samples(mode.frequency, motion.dt) < 0.9) {
        fastest = &mode;
      }
    }
    if (!fastest) continue;
    out.push_back(fmt::format("the ground motion has a sample each {:g} ms: straight lines between them keep only {:.0f} % of what shakes "
                              "mode {} of '{}' ({:.3g} Hz)",
                              1e3 * motion.dt, 100 * kept_between_samples(fastest->frequency, motion.dt), fastest->mode,
                              fastest->structure, fastest->frequency));
  }
}

constexpr double much_created = 1e-4;  // of the largest energy that the run met

void of_created_energy(const Model&, const Summary& summary, Sentences& out) {
  const Energy& e = summary.energy;
  const double scale = std::max({e.initial, e.kinetic, std::abs(e.input), std::abs(e.strain), std::abs(e.contact)});
  const CreatedEnergy& created = summary.created;
  if (!(created.sum > much_created * scale)) return;
  out.push_back(fmt::format("Newton's law of restitution created {:.3g} J where several pairs collided at once, {:.3g} J of it at "
                            "t = {:.4g} s: impact_law = \"poisson\" creates none",
                            created.sum, created.largest, created.largest_time));
}

void of_halved_steps(const Model&, const Summary& summary, Sentences& out) {
  if (summary.steps == 0 || summary.halved_steps * 100 < summary.steps || summary.halved_steps == 0) return;
  out.push_back(fmt::format("steps did not converge and were halved {} times in {} steps: a smaller dt would be more accurate and not slower",
                            summary.halved_steps, summary.steps));
}

void of_softened_members(const Model&, const Summary& summary, Sentences& out) {
  const std::size_t count = summary.softened_members.size();
  if (count == 0) return;
  out.push_back(fmt::format("in {} force-based member{} ({}{}) a section softened: such a member can have several states at one deformation "
                            "and jump between them, so that results need not settle with dt; element = \"displacement\" does not jump",
                            count, count == 1 ? "" : "s", summary.softened_members[0], count > 1 ? ", ..." : ""));
}

constexpr double followed = 1;  // angle in a step, up to which a ringing keeps its phase until the next pounding

void of_struck_points(const Model&, const Summary& summary, Sentences& out) {
  if (summary.impacts.empty() || !(2 * pi * summary.struck_frequency * summary.dt > followed)) return;
  out.push_back(fmt::format("struck points ring at up to {:.0f} Hz, which steps of {:g} ms do not follow: unless damping ends that before the next "
                            "pounding, its outcome depends on dt; exact and exponential follow it at any dt",
                            summary.struck_frequency, 1e3 * summary.dt));
}

void of_stiffening(const Model&, const Summary& summary, Sentences& out) {
  if (summary.stiffened_steps == 0) return;
  out.push_back(fmt::format("members stiffened beyond their stiffness at rest: alpha-OS would be unstable, and {} of {} steps were made by its "
                            "implicit form; integrator = \"generalized-alpha\" is that everywhere",
                            summary.stiffened_steps, summary.steps));
}

constexpr double enough_mass = 0.9;  // Eurocode 8, 4.3.3.3.1(3)

void of_left_out_modes(const Model&, const Summary& summary, Sentences& out) {
  if (summary.kept_mass < enough_mass) {
    out.push_back(fmt::format("modes up to highest_frequency hold only {:.0f} % of the mass that the motion shakes: forces and drifts may come out too low",
                              100 * summary.kept_mass));
  }
}

using Rule = void (*)(const Model&, const Summary&, Sentences&);
constexpr Rule rules[]{of_the_scheme,  of_light_contact_nodes, of_effective_restitution,
                       of_penetration, of_short_contacts,      of_coarse_motions,
                       of_created_energy, of_halved_steps,     of_softened_members,
                       of_struck_points,       of_stiffening,          of_left_out_modes};

}  // namespace

std::vector<std::string> run_warnings(const Model& model, const Summary& summary) {
  Sentences all, out;
  for (const Rule rule : rules) rule(model, summary, all);
  for (const std::string& sentence : all) {  // one record along x and y says the same twice
    if (std::find(out.begin(), out.end(), sentence) == out.end()) out.push_back(sentence);
  }
  return out;
}

}  // namespace nsframe

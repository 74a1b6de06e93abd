// Bilinear hysteresis with deterioration of strength, capping and unloading stiffness by dissipated energy (Ibarra,
// Medina, Krawinkler 2005; Lignos, Krawinkler 2011; OpenSees' IMKBilin).
//
// The backbone of a side: elastic Ke to Fy, slope Kp to (Ucap, Fcap), softening Kpc to the residual strength, failure
// at du. Between the backbones the response is a line of the unloading stiffness K. Deterioration is by
//   beta = (E_i/(Lamda Fy_pos - W))^c,
// W the energy dissipated so far, E_i its part in the excursion that ends: K by 1 - beta_K where a backbone is left;
// where the force changes sign, Fy and Kp of the side ahead by 1 - beta_S D, its softening line by 1 - beta_C D.
// beta of 1 or more, or all energy used, is collapse: no force for ever.
#if defined(NSFRAME_MATERIALS_IMK_BILIN_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef NSFRAME_MATERIALS_IMK_BILIN_HPP
#undef NSFRAME_MATERIALS_IMK_BILIN_HPP
#else
#define NSFRAME_MATERIALS_IMK_BILIN_HPP
#endif

#include "materials/law.hpp"
#include "materials/number.hpp"

#ifndef NSFRAME_MATERIALS_IMK_BILIN_PARAMETERS
#define NSFRAME_MATERIALS_IMK_BILIN_PARAMETERS
namespace nsframe {

// One side of the backbone, signs so that it is the positive one.
struct ImkSide {
  double Fy, plastic, softening, ultimate, peak_ratio, residual_ratio, D;
  double Fcap() const { return peak_ratio * Fy; }
  double residual() const { return residual_ratio * Fy; }
  double Kp() const { return (Fcap() - Fy) / plastic; }
  double Kpc() const { return Fcap() / softening; }
};

struct IMKBilin {
  static constexpr const char* name = "IMKBilin";
  double Ke = 0;                                      // [Pa] (in a spring [N/m] or [N m/rad])
  double dp_pos = 0, dpc_pos = 0, du_pos = 0;         // plastic, post-capping, ultimate deformation [-]
  double Fy_pos = 0, FmaxFy_pos = 1, FresFy_pos = 0;  // yield force [Pa]; capping, residual force over it [-]
  double dp_neg = 0, dpc_neg = 0, du_neg = 0;         // the other side; positive values
  double Fy_neg = 0, FmaxFy_neg = 1, FresFy_neg = 0;
  double Lamda_S = 0, Lamda_C = 0, Lamda_K = 0;  // energy over Fy_pos [-]; 0: no such deterioration
  double c_S = 1, c_C = 1, c_K = 1;              // rates [-]
  double D_pos = 1, D_neg = 1;                   // of the sides [-]

  template <class T>
  struct SideHistory {
    T Fy, Kp, Kpc, Ucap, Fcap;  // of the deteriorated backbone, Kpc <= 0
    T failed;                   // 0 or 1
  };
  template <class T>
  struct History {
    T strain;         // [-]
    T stress;         // [Pa]
    T K;              // unloading stiffness [Pa]
    T energy;         // W [J/m3]
    T energy_before;  // W at the end of the last excursion
    T on_backbone;    // 0 or 1
    T stage;          // 0 elastic, 1 has yielded, 2 has reached a residual strength (or failed)
    SideHistory<T> pos, neg;
  };
  ImkSide pos() const { return {Fy_pos, dp_pos, dpc_pos, du_pos, FmaxFy_pos, FresFy_pos, D_pos}; }
  ImkSide neg() const { return {Fy_neg, dp_neg, dpc_neg, du_neg, FmaxFy_neg, FresFy_neg, D_neg}; }
  History<double> virgin() const { return {0, 0, Ke, 0, 0, 0, 0, virgin_side(pos()), virgin_side(neg())}; }
  double initial_tangent() const { return Ke; }
  double yield_strain() const { return std::min(Fy_pos, Fy_neg) / Ke; }
  template <class Visit, class Law>
  static void visit_parameters(Visit&& visit, Law& law) {
    using namespace parameter;
    visit(required(stress("Ke", "elastic stiffness", range::positive)), law.Ke);
    visit(required(strain("dp_pos", "plastic deformation up to the cap, positive side", range::positive)), law.dp_pos);
    visit(required(strain("dpc_pos", "post-capping deformation down to zero, positive side", range::positive)),
          law.dpc_pos);
    visit(required(strain("du_pos", "deformation at failure, positive side", range::positive)), law.du_pos);
    visit(required(stress("Fy_pos", "yield strength, positive side", range::positive)), law.Fy_pos);
    visit(required(number("FmaxFy_pos", "strength at the cap over the yield strength", range::at_least_one)),
          law.FmaxFy_pos);
    visit(required(number("FresFy_pos", "residual strength over the yield strength", {0, 1, false, true})),
          law.FresFy_pos);
    visit(required(
              strain("dp_neg", "plastic deformation up to the cap, negative side, positive number", range::positive)),
          law.dp_neg);
    visit(required(strain("dpc_neg", "post-capping deformation down to zero, negative side, positive number",
                          range::positive)),
          law.dpc_neg);
    visit(required(strain("du_neg", "deformation at failure, negative side, positive number", range::positive)),
          law.du_neg);
    visit(required(stress("Fy_neg", "yield strength, negative side, positive number", range::positive)), law.Fy_neg);
    visit(required(number("FmaxFy_neg", "strength at the cap over the yield strength", range::at_least_one)),
          law.FmaxFy_neg);
    visit(required(number("FresFy_neg", "residual strength over the yield strength", {0, 1, false, true})),
          law.FresFy_neg);
    visit(required(number("Lamda_S", "energy by which the strength deteriorates, over Fy_pos; 0: never",
                          range::non_negative)),
          law.Lamda_S);
    visit(required(number("Lamda_C", "energy by which the post-capping strength deteriorates, over Fy_pos; 0: never",
                          range::non_negative)),
          law.Lamda_C);
    visit(required(number("Lamda_K", "energy by which the unloading stiffness deteriorates, over Fy_pos; 0: never",
                          range::non_negative)),
          law.Lamda_K);
    visit(number("c_S", "rate of deterioration of the strength", range::positive), law.c_S);
    visit(number("c_C", "rate of deterioration of the post-capping strength", range::positive), law.c_C);
    visit(number("c_K", "rate of deterioration of the unloading stiffness", range::positive), law.c_K);
    visit(number("D_pos", "share of the deterioration on this side", range::unit), law.D_pos);
    visit(number("D_neg", "share of the deterioration on this side", range::unit), law.D_neg);
  }

 private:
  SideHistory<double> virgin_side(const ImkSide& s) const {
    return {s.Fy, s.Kp(), -s.Kpc(), s.Fy / Ke + s.plastic, s.Fcap(), 0};
  }
};

}  // namespace nsframe
#endif

HWY_BEFORE_NAMESPACE();
namespace nsframe {
namespace HWY_NAMESPACE {

template <class T>
HWY_INLINE T raise(T base, double exponent) {
  return exponent == 1 ? base : pow(base, T(exponent));
}

// The part of strength that an excursion takes; 1 or more is collapse.
template <class T>
HWY_INLINE T deterioration(T excursion, T dissipated, double capacity, double rate) {
  const T left = T(capacity) - dissipated, used = max(excursion, T(0.0));
  const auto exhausted = left <= T(0.0);
  return select(exhausted, T(2.0), raise(used / select(exhausted, T(1.0), left), rate));
}

// The backbone ahead after an excursion; (strain, stress) a point on the line of slope K towards it.
template <class T>
HWY_INLINE IMKBilin::SideHistory<T> deteriorate(const IMKBilin::SideHistory<T>& side, T Fy0, T Kpc0, T residual,
                                                double Ke, T strength, T capping, T strain, T stress, T K) {
  const T zero(0.0), one(1.0);
  IMKBilin::SideHistory<T> d = side;
  const T softening_line = (side.Fcap - side.Kpc * side.Ucap) * capping;  // its force at zero strain
  d.Fy = side.Fy * strength;
  d.Kp = side.Kp * strength;
  d.Kpc = select(d.Fy < residual, zero, -Kpc0 * (d.Fy - residual) / (Fy0 - residual));
  const T hardening_line = d.Fy - d.Kp * d.Fy * T(1 / Ke);
  const auto crossing = d.Kp > d.Kpc;
  d.Ucap = select(crossing, (softening_line - hardening_line) / select(crossing, d.Kp - d.Kpc, one), zero);
  d.Fcap = hardening_line + d.Kp * d.Ucap;
  // no steeper than from where the line K passes the residual strength to the cap
  const T steepest = (d.Fcap - residual) / (d.Ucap - strain - (residual - stress) / K);
  d.Kp = select(both(steepest > zero, d.Kp > steepest), steepest, d.Kp);
  const auto lost = d.Fcap < residual;
  d.Fy = select(lost, residual, d.Fy);
  d.Fcap = select(lost, residual, d.Fcap);
  d.Kp = select(lost, zero, d.Kp);
  d.Kpc = select(lost, zero, d.Kpc);
  d.Ucap = select(lost, zero, d.Ucap);
  return d;
}

template <class T, class Mask>
HWY_INLINE IMKBilin::SideHistory<T> choose(Mask first, const IMKBilin::SideHistory<T>& a,
                                           const IMKBilin::SideHistory<T>& b) {
  return {select(first, a.Fy, b.Fy),     select(first, a.Kp, b.Kp),     select(first, a.Kpc, b.Kpc),
          select(first, a.Ucap, b.Ucap), select(first, a.Fcap, b.Fcap), select(first, a.failed, b.failed)};
}

// True where the strain is on the residual branch of a side.
template <class T>
HWY_INLINE auto at_residual(const IMKBilin::SideHistory<T>& side, T residual, T strain, T stress) {
  const auto flat = side.Kpc == T(0.0);
  const T begin = side.Ucap + (residual - side.Fcap) / select(flat, T(-1.0), side.Kpc);
  return either(both(flat, stress == residual), both(side.Kpc < T(0.0), strain >= begin));
}

// What the energy dissipated so far takes: of the unloading stiffness where a backbone is left, of strength and cap
// where the force changes sign; and whether it is all that there is.
template <class T>
struct ImkLoss {
  T stiffness, strength, cap;             // factors 1 - beta
  T collapse_leaving, collapse_crossing;  // beta above 1: that is collapse
};

template <class T>
HWY_INLINE ImkLoss<T> lose(const IMKBilin& law, const IMKBilin::History<T>& committed, T share) {
  const T zero(0.0), one(1.0), W = committed.energy, excursion = W - committed.energy_before;
  ImkLoss<T> loss{one, one, one, zero, zero};
  if (law.Lamda_K > 0) {
    const T elastic = T(0.5) * committed.stress * committed.stress / committed.K;
    const T beta = deterioration(excursion - elastic, W - elastic, law.Lamda_K * law.Fy_pos, law.c_K);
    loss.stiffness = max(zero, one - beta);
    loss.collapse_leaving = beta;
  }
  if (law.Lamda_S > 0) {
    const T beta = deterioration(excursion, W, law.Lamda_S * law.Fy_pos, law.c_S);
    loss.strength = one - min(beta, one) * share;
    loss.collapse_crossing = beta;
  }
  if (law.Lamda_C > 0) {
    const T beta = deterioration(excursion, W, law.Lamda_C * law.Fy_pos, law.c_C);
    loss.cap = one - min(beta, one) * share;
    loss.collapse_crossing = max(loss.collapse_crossing, beta);
  }
  return loss;
}

template <class T>
HWY_INLINE Response<T, IMKBilin> respond(const IMKBilin& law, T strain_given, const IMKBilin::History<T>& committed) {
  using Side = IMKBilin::SideHistory<T>;
  const ImkSide pos = law.pos(), neg = law.neg();
  const T zero(0.0), one(1.0);
  const T given = strain_given - committed.strain;
  const auto up = either(given > zero, both(given == zero, committed.stress >= zero));
  const auto pick = [up](double a, double b) HWY_ATTR { return select(up, T(a), T(b)); };
  // from here on the mirrored picture, in which the strain increases
  const T sign = select(up, one, -one);
  const T strain = sign * strain_given, strain0 = sign * committed.strain, stress0 = sign * committed.stress;
  const T increment = strain - strain0;
  const T residual = pick(pos.residual(), neg.residual()), residual_behind = pick(neg.residual(), pos.residual());
  Side ahead = choose(up, committed.pos, committed.neg), behind = choose(up, committed.neg, committed.pos);
  const auto moves = increment > zero, was_on = committed.on_backbone > zero;
  const auto dead = both(ahead.failed > zero, behind.failed > zero);

  const ImkLoss<T> loss = lose(law, committed, pick(pos.D, neg.D));
  const auto leaves = both(both(was_on, moves), either(stress0 < zero, both(stress0 == zero, strain0 <= zero)));
  T K = select(leaves, committed.K * loss.stiffness, committed.K);
  K = select(both(leaves, committed.stage > one), T(0.5 * law.Ke), K);
  T stress = stress0 + K * increment;
  const auto crosses =
      both(both(except(moves, except(was_on, leaves)), stress0 * stress <= zero), committed.stage > zero);
  const Side weakened = deteriorate(ahead, pick(pos.Fy, neg.Fy), pick(pos.Kpc(), neg.Kpc()), residual, law.Ke,
                                    loss.strength, loss.cap, strain0, stress0, K);
  ahead = choose(except(crosses, ahead.failed > zero), weakened, ahead);  // else a side without strength fades to 1e-308
  const auto collapses =
      either(dead, either(both(leaves, loss.collapse_leaving > one), both(crosses, loss.collapse_crossing > one)));

  // the backbone ahead bounds the stress; a side is down to its residual strength when the other one has failed
  const T slope = select(strain < ahead.Ucap, ahead.Kp, ahead.Kpc);
  const T line = ahead.Fcap + (strain - ahead.Ucap) * slope;
  const auto failed = ahead.failed > zero, flat = either(failed, either(line<residual, behind.failed> zero));
  const T backbone = select(failed, zero, select(flat, residual, line));
  const auto reaches = both(stress > backbone, moves), on = either(reaches, except(was_on, leaves));
  stress = select(reaches, backbone, stress);
  const auto exhausted = both(moves, either(strain >= pick(pos.ultimate, neg.ultimate), both(on, stress <= zero)));
  const auto fails = either(collapses, exhausted);
  const auto weak =
      either(at_residual(ahead, residual, strain, stress), at_residual(behind, residual_behind, -strain, -stress));
  stress = select(fails, zero, stress);
  ahead.failed = select(fails, one, ahead.failed);
  behind.failed = select(collapses, one, behind.failed);

  IMKBilin::History<T> h = committed;
  h.strain = strain_given;
  h.stress = sign * stress;
  h.K = K;
  h.energy = committed.energy + select(dead, zero, T(0.5) * (stress + stress0) * increment);
  h.energy_before = select(crosses, committed.energy, committed.energy_before);
  h.on_backbone = select(on, one, zero);
  h.stage = select(either(fails, weak), T(2.0), max(committed.stage, h.on_backbone));
  h.pos = choose(up, ahead, behind);
  h.neg = choose(up, behind, ahead);
  return {h.stress, select(fails, zero, select(on, select(flat, zero, slope), K)), h};
}

}  // namespace HWY_NAMESPACE
}  // namespace nsframe
HWY_AFTER_NAMESPACE();

#endif
